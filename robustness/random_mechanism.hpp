#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "flexura/model/model.hpp"

namespace flexura::robustness {

/// A valid model with one study of kind `path` by modeling `exact`, made from a seed alone.
struct RandomMechanism {
  std::uint64_t seed = 0;
  std::string family;        ///< "serial chain", "parallel stage", "closed loops", "arch"
  double slenderness = 0.0;  ///< length over thickness of the middle flexure
  double load = 0.0;         ///< largest force in EI/L^2 or moment in EI/L
  Model model;
};

RandomMechanism make_random_mechanism(std::uint64_t seed);

/// Likewise from any source of random bits; `seed` only names it.
RandomMechanism make_random_mechanism(std::uint64_t seed,
                                      const std::function<std::uint64_t()>& source);

/// The model as a file for `flexura run`.
std::string write_model(const RandomMechanism& mechanism);

}  // namespace flexura::robustness

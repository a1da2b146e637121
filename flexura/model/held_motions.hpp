#pragma once

#include <cstddef>
#include <vector>

#include "flexura/model/model.hpp"

namespace flexura {

/// A joint or a driver: what holds rigid bodies.
struct Holder {
  enum class Kind { driver, joint };
  Kind kind = Kind::joint;
  std::size_t index = 0;  ///< into the model's joints or drivers

  // clang-tidy 14 takes the defaulted comparison for a null pointer
  friend auto operator<=>(const Holder&, const Holder&) = default;  // NOLINT
};

/// A joint that holds, in the mechanism as drawn, a motion which drivers and joints before it hold
/// already: together they leave forces undetermined that no flexure shares.
struct RedundantJoint {
  std::size_t joint = 0;
  std::vector<Holder> holders;  ///< drivers first
};

/// All of them, in the order of the file. Copes with any model.
std::vector<RedundantJoint> find_redundant_joints(const Model& model);

}  // namespace flexura

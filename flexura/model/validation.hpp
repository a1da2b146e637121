#pragma once

#include <string>
#include <vector>

#include "flexura/core/diagnostics.hpp"
#include "flexura/model/model.hpp"

namespace flexura {

/// Where something stands in a model, as the keys that lead there in a model file; "[2]" is the
/// third entry of a list.
using KeyPath = std::vector<std::string>;

/// "studies.push.loads[0].force"
std::string to_text(const KeyPath& path);

KeyPath operator/(KeyPath path, std::string key);
KeyPath operator/(KeyPath path, std::size_t index);

/// A broken rule. `independent` says that it holds whatever else is wrong below its path.
struct Mistake {
  KeyPath path;
  std::string message;
  bool independent = false;
};

/// Which rules can be judged: those about how bodies hang together need to know what is fixed
/// and what every flexure and joint joins; those about pins and about joints that hold the same
/// need to know where everything is as well.
struct ValidationScope {
  bool connections = true;
  bool pins = true;
};

/// Every broken rule of a model, in no particular order. Never throws on a bad model: indices may
/// lie outside their lists, numbers may be NaN.
std::vector<Mistake> find_mistakes(const Model& model, const ValidationScope& scope);

/// What is allowed but hardly meant: a material whose modulus lies outside what materials have,
/// which is a unit gone wrong. Of a model without mistakes there; units that cannot be read have
/// none.
std::vector<Mistake> find_doubts(const Model& model);

/// Every broken rule of a model, sorted by position (that of the material, section, body, flexure,
/// spring, joint, driver or study concerned), each with the place in words. Empty means valid:
/// studies may rely on it.
Diagnostics validate_model(const Model& model);

}  // namespace flexura

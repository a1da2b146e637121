#include "flexura/studies/singular_mechanism.hpp"

#include <fmt/format.h>

namespace flexura {

std::string describe_singular(const Model& model, std::optional<std::size_t> softest_body) {
  if (!softest_body)
    return "the mechanism is over-constrained: without axial strain its flexures cannot move "
           "together, or how they share a load is open. Allow axial strain (axial = true); of "
           "pseudo-rigid "
           "chains, take one with more joints";
  return fmt::format(
      "the unloaded mechanism is singular: body '{}' can move without bending any "
      "flexure. Hold it by another flexure, or pin fewer ends",
      model.bodies[*softest_body].name);
}

}  // namespace flexura

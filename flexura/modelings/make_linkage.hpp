#pragma once

#include "flexura/assembly/linkage_system.hpp"
#include "flexura/model/model.hpp"

namespace flexura {

/// A linkage as its bodies and flexures move when rigid: which part each of them belongs to.
/// Bodies and flexures that are clamped to one another are one part.
struct RigidParts {
  RigidLinkageLayout layout;
  std::vector<std::size_t> of_bodies;
  std::vector<std::size_t> of_flexures;
};
/// Precondition: the driver turns a body that is not fixed.
RigidParts rigid_parts(const Model& model, std::size_t driver);

/// The linkage of a study; `refined`: twice the beam elements, or flexures refined once.
LinkageLayout make_linkage(const Model& model, const LinkageStudy& study, bool refined = false);

/// Places of all bodies' centres, with their unknowns in the layout that make_linkage makes.
std::vector<LinkageLayout::Place> body_places(const Model& model, const RigidParts& parts);

}  // namespace flexura

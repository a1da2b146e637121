#pragma once

#include <memory>

#include "flexura/geometry/mesh_link.hpp"
#include "flexura/io/reading.hpp"

namespace flexura {

/// A flexure's `mesh`: the elements of a file beside the model file, or of a part of it, and the
/// named edges that are fastened. Null after a mistake.
std::shared_ptr<const MeshLink> read_mesh_link(Reading& reading, const Place& place);

}  // namespace flexura

#pragma once

#include <memory>

#include "flexura/geometry/mesh_link.hpp"
#include "flexura/io/reading.hpp"

namespace flexura {

/// A flexure's `outline`, meshed: its border, its holes, and the named edges that are fastened.
/// Null after a mistake.
std::shared_ptr<const MeshLink> read_outline_link(Reading& reading, const Place& place);

}  // namespace flexura

#pragma once

#include <array>
#include <vector>

#include "flexura/assembly/system_layout.hpp"

namespace flexura {

/// Numbers of what can move in a mechanism: bodies' positions and rotations, and the rotations of
/// pinned ends, which are their own.
struct Numbering {
  struct Body {
    int position = -1;  ///< of x; y follows. -1: held
    int rotation = -1;
  };
  struct Member {
    std::array<int, port_unknowns> unknowns{};  ///< in the order of PortUnknown, -1 where held
  };

  explicit Numbering(const SystemLayout& layout);

  std::vector<Body> bodies;
  std::vector<Member> members;
  std::size_t moving = 0;  ///< how many
};

}  // namespace flexura

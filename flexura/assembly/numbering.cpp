#include "flexura/assembly/numbering.hpp"

namespace flexura {

Numbering::Numbering(const SystemLayout& layout) {
  int next = 0;
  for (const auto& body : layout.bodies) {
    Body index;
    if (body.moves) {
      index.position = next;
      next += 2;
      if (body.turns) index.rotation = next++;
    }
    bodies.push_back(index);
  }
  for (const auto& member : layout.members) {
    const Body& a = bodies[member.base];
    const Body& b = bodies[member.action];
    const int own_base = member.pinned_base ? next++ : a.rotation;
    const int own_action = member.pinned_action ? next++ : b.rotation;
    members.push_back({{a.position, a.position < 0 ? -1 : a.position + 1, a.rotation, own_base,
                        b.position, b.position < 0 ? -1 : b.position + 1, b.rotation, own_action}});
  }
  moving = static_cast<std::size_t>(next);
}

}  // namespace flexura

#include "flexura/studies/reaction_difference.hpp"

#include <algorithm>
#include <cmath>

namespace flexura {

double reaction_difference(const ModelingPath& path, const ModelingPath& reference, double length) {
  double force = 0.0;
  double moment = 0.0;
  for (const PathState& state : reference.states)
    for (const Reaction& r : state.reactions) {
      force = std::max(force, norm(r.force));
      moment = std::max(moment, std::abs(r.moment));
    }
  if (length > 0.0) {
    moment = std::max(moment, force * length);
    force = std::max(force, moment / length);
  }
  double worst = 0.0;
  const std::size_t states = std::min(path.states.size(), reference.states.size());
  for (std::size_t k = 0; k < states; ++k) {
    const auto& here = path.states[k].reactions;
    const auto& there = reference.states[k].reactions;
    for (std::size_t h = 0; h < std::min(here.size(), there.size()); ++h) {
      if (force > 0.0) worst = std::max(worst, norm(here[h].force - there[h].force) / force);
      if (moment > 0.0)
        worst = std::max(worst, std::abs(here[h].moment - there[h].moment) / moment);
    }
  }
  return worst;
}

}  // namespace flexura

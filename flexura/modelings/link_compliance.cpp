#include "flexura/modelings/link_compliance.hpp"

#include <cmath>

namespace flexura {

std::vector<SectionState> link_sections(Vec2 drawn, const Pose& tip, const Eigen::Vector3d& load,
                                        bool first_order) {
  const Vec2 f{load[0], load[1]};
  const Vec2 end_slope =
      first_order ? drawn + tip.rotation * perp(drawn) : rotate(tip.rotation, drawn);
  const Vec2 along = (1.0 / norm(drawn)) * drawn;
  std::vector<SectionState> states;
  for (int k = 0; k < station_count; ++k) {
    const double t = static_cast<double>(k) / (station_count - 1);
    const double h = t * t * (3.0 - 2.0 * t);
    const Vec2 place =
        t * (1.0 - t) * (1.0 - t) * drawn + h * tip.position + t * t * (t - 1.0) * end_slope;
    const Pose pose{place, h * tip.rotation};
    const Vec2 e = first_order ? along : rotate(pose.rotation, along);
    const Vec2 arm = first_order ? (1.0 - t) * drawn : tip.position - place;
    states.push_back({pose, dot(f, e), dot(f, perp(e)), load[2] + cross(arm, f)});
  }
  return states;
}

}  // namespace flexura

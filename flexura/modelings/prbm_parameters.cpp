#include <algorithm>
#include <cmath>

#include "flexura/modelings/compliance.hpp"
#include "flexura/modelings/prbm.hpp"

namespace flexura {
namespace {

/// The flexure's own frame: origin at the elastic centre (bending alone), y along the symmetry
/// axis from there towards the middle of the axis, x across it from the base end to the action
/// end; left-handed for one sense of sweep.
struct FlexureFrame {
  Vec2 origin;
  Vec2 x;
  Vec2 y;

  Vec2 point(Vec2 local) const { return origin + local.x * x + local.y * y; }
};

FlexureFrame flexure_frame(const FlexureProperties& flexure, Vec2 centre) {
  const double middle = 0.5 * flexure.axis.length();
  const Vec2 x = unit(flexure.axis.tangent_angle(middle));
  const Vec2 n = perp(x);
  const bool towards = dot(flexure.axis.position(middle) - centre, n) >= 0.0;
  return {centre, x, towards ? n : -n};
}

Eigen::Matrix3d bending_compliance(FlexureProperties flexure, Vec2 at) {
  flexure.axial_compliance = 0.0;
  flexure.shear_compliance = 0.0;
  return compliance_matrix(flexure, at);
}

/// Equal springs k = 3/w at (-p, q1), (0, q2), (p, q1) match the elastic weight w, the centre and
/// both semi-axes a, b of the bending ellipse: p = a sqrt(3/2), q1 = -b/sqrt 2, q2 = b sqrt 2
/// (docs/prbm.md).
PseudoRigidChain equal_springs(const FlexureProperties& flexure) {
  const Vec2 end = flexure.axis.position(flexure.axis.length());
  const Vec2 centre = elastic_centre(bending_compliance(flexure, end), end);
  const Eigen::Matrix3d c = bending_compliance(flexure, centre);
  const FlexureFrame frame = flexure_frame(flexure, centre);
  const auto compliance_along = [&c](Vec2 d) {
    const Eigen::Vector3d v(d.x, d.y, 0.0);
    return v.dot(c * v);
  };
  const double w = c(2, 2);
  const double a = std::sqrt(compliance_along(frame.y) / w);
  const double b = std::sqrt(std::max(0.0, compliance_along(frame.x)) / w);
  const double p = a * std::sqrt(1.5);
  const double q1 = -b / std::sqrt(2.0);
  const double q2 = b * std::sqrt(2.0);
  return {{frame.point({-p, q1}), frame.point({0.0, q2}), frame.point({p, q1})},
          std::vector<double>(3, 3.0 / w)};
}

/// Joints on the straight line between the ends: `lengths` of the segments as fractions of it,
/// `stiffness` in EI/L.
PseudoRigidChain straight_chain(const FlexureProperties& flexure,
                                const std::vector<double>& lengths,
                                const std::vector<double>& stiffness) {
  const double length = flexure.axis.length();
  PseudoRigidChain chain;
  double s = 0.0;
  for (std::size_t k = 0; k < stiffness.size(); ++k) {
    s += lengths[k] * length;
    chain.joints.push_back(flexure.axis.position(s));
    chain.stiffness.push_back(stiffness[k] * flexure.bending_stiffness / length);
  }
  return chain;
}

PseudoRigidChain joint_chain(const FlexureProperties& flexure, const PrbmJoints& parameters) {
  const double length = flexure.axis.length();
  const Vec2 end = flexure.axis.position(length);
  const Vec2 centre = elastic_centre(bending_compliance(flexure, end), end);
  const FlexureFrame frame = flexure_frame(flexure, centre);
  PseudoRigidChain chain;
  for (std::size_t k = 0; k < parameters.joints.size(); ++k) {
    chain.joints.push_back(frame.point(length * parameters.joints[k]));
    chain.stiffness.push_back(parameters.stiffness[k] * flexure.bending_stiffness / length);
  }
  return chain;
}

}  // namespace

HowellParameters howell_parameters(double n) {
  n = std::clamp(n, -5.0, 10.0);
  HowellParameters p;
  if (n > 0.5)
    p.radius = 0.841655 - 0.0067807 * n + 0.000438 * n * n;
  else if (n > -1.8316)
    p.radius = 0.852144 - 0.0182867 * n;
  else
    p.radius = 0.912364 + 0.0145928 * n;
  const auto horner = [n](std::initializer_list<double> from_highest) {
    double v = 0.0;
    for (const double c : from_highest) v = v * n + c;
    return v;
  };
  if (n <= -2.5)
    p.stiffness = horner({0.003169, 0.121290, 3.024112});
  else if (n <= -1.0)
    p.stiffness = horner({-0.113063, -0.891906, -2.649437, -3.738166, -2.616021, 1.967647});
  else
    p.stiffness = horner({0.0000584525, -0.00142039, 0.0126749, -0.0509896, 2.654855});
  return p;
}

HowellParameters howell_end_moment() { return {0.7346, 1.5164 / 0.7346}; }

PseudoRigidChain pseudo_rigid_chain(const FlexureProperties& flexure, const PrbmSettings& settings,
                                    std::optional<double> load_ratio) {
  const auto& parameters = settings.parameters;
  if (std::holds_alternative<PrbmSu>(parameters))
    return straight_chain(flexure, {0.10, 0.35, 0.40, 0.15}, {3.51, 2.99, 2.58});
  if (const auto* howell = std::get_if<PrbmHowell>(&parameters)) {
    const auto ratio = howell->load_ratio ? howell->load_ratio : load_ratio;
    const HowellParameters p = ratio ? howell_parameters(*ratio) : howell_end_moment();
    return straight_chain(flexure, {1.0 - p.radius, p.radius}, {p.radius * p.stiffness});
  }
  if (const auto* segments = std::get_if<PrbmSegments>(&parameters))
    return straight_chain(flexure, segments->lengths, segments->stiffness);
  if (const auto* joints = std::get_if<PrbmJoints>(&parameters))
    return joint_chain(flexure, *joints);
  return equal_springs(flexure);
}

}  // namespace flexura

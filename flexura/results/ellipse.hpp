#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "flexura/core/vec2.hpp"

namespace flexura {

/// Order force x, force y, moment; displacement x, y, rotation. Row-major.
using ComplianceMatrix = std::array<std::array<double, 3>, 3>;

/// The line { x : normal . (x - origin) = offset }, |normal| = 1.
struct Line2 {
  Vec2 origin;
  Vec2 normal;
  double offset = 0.0;
};

/// The ellipse of elasticity: elastic weight w (rotation per moment), its centre, and semi-axes
/// such that a force along one axis through the centre displaces by w (other semi-axis)^2.
struct Ellipse {
  double weight = 0.0;
  Vec2 centre;
  double major = 0.0;  ///< semi-axes, major >= minor >= 0
  double minor = 0.0;
  double orientation = 0.0;  ///< angle of the major axis from global x, in (-pi/2, pi/2]
};

/// Compliance of a flexure (load at its action end, base body held), of a body (load at its
/// centre) or of a point.
struct ElasticityRecord {
  enum class Of { flexure, body, point };
  Of of = Of::flexure;
  std::string name;
  Vec2 at;  ///< the point at which the matrix holds
  ComplianceMatrix compliance{};
  std::optional<Ellipse> ellipse;  ///< absent where no moment turns the body (weight zero)
  /// Displacement per force at `at` along the two principal directions, greater first.
  std::array<double, 2> principal_compliances{};
  std::array<Vec2, 2> principal_directions{};
  /// The antipolar line of `at`: the poles of all forces through `at` lie on it. Absent where `at`
  /// is the elastic centre.
  std::optional<Line2> antipolar;
};

/// The centre of rotation of a body under one load of the study.
struct PoleRecord {
  std::string load;  ///< the body or point it acts on
  Vec2 force;
  double moment = 0.0;
  Vec2 displacement;  ///< of the loaded point
  double rotation = 0.0;
  std::optional<Vec2> pole;  ///< absent where the body translates
};

struct LinearResult {
  std::vector<ElasticityRecord> records;
  std::vector<PoleRecord> poles;
};

}  // namespace flexura

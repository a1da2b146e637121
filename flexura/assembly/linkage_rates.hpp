#pragma once

#include <Eigen/Dense>
#include <vector>

#include "flexura/assembly/linkage_system.hpp"

// What the files of LinkageSystem have in common; included by them only.

namespace flexura {

/// Turns and accelerations of a part by time over the mean rate of the drive, and its square.
struct PartRates {
  double spin = 0.0;
  double spin_rate = 0.0;
};
inline PartRates rates_of(const PartMotion& part, const DriveRate& drive) {
  return {drive.rate * part.first_turn,
          drive.rate * drive.rate * part.second_turn + drive.rate * drive.slope * part.first_turn};
}
inline Vec2 acceleration_of(const PartMotion& point, const DriveRate& drive) {
  return (drive.rate * drive.rate) * point.second + (drive.rate * drive.slope) * point.first;
}

/// Turns pairs of rows, T^T a with T that of unknowns along fixed axes into those of a link.
template <class Matrix>
void turn_rows(Matrix& a, const std::vector<Eigen::Index>& pairs, Vec2 e) {
  for (const Eigen::Index i : pairs) {
    const Eigen::RowVectorXd x = a.row(i);
    a.row(i) = e.x * x - e.y * a.row(i + 1);
    a.row(i + 1) = e.y * x + e.x * a.row(i + 1);
  }
}
}  // namespace flexura

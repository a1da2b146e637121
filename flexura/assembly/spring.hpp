#pragma once

#include <cmath>

namespace flexura {

/// A spring between two points: 1/2 k (length - free length)^2, by the vector (x, y) from one point
/// to the other. One of no free length needs no length: it stays smooth where the points meet.
template <class Scalar>
Scalar spring_energy(const Scalar& x, const Scalar& y, double stiffness, double free_length) {
  using std::sqrt;
  const Scalar squared = x * x + y * y;
  if (free_length == 0.0) return (0.5 * stiffness) * squared;
  const Scalar elongation = sqrt(squared) - free_length;
  return (0.5 * stiffness) * (elongation * elongation);
}

/// A torsion spring between two bodies, by their relative rotation.
template <class Scalar>
Scalar torsion_spring_energy(const Scalar& turn, double stiffness, double free_angle) {
  const Scalar excess = turn - free_angle;
  return (0.5 * stiffness) * (excess * excess);
}

}  // namespace flexura

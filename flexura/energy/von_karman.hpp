#pragma once

namespace flexura {

/// Axial strain of a beam whose deflection w(x) is moderate (von Karman): u' + w'^2/2 (first
/// source, eq. 14).
template <class Scalar>
Scalar von_karman_axial_strain(const Scalar& du, const Scalar& dw) {
  return du + 0.5 * (dw * dw);
}

/// Curvature of the graph w(x), exactly: w''/(1 + w'^2)^(3/2) (first source, eq. 27). With shear,
/// `slope` is that of the sections' normals, w' - gamma, and `change` its derivative.
template <class Scalar>
Scalar graph_curvature(const Scalar& slope, const Scalar& change) {
  using std::sqrt;
  const Scalar stretch = 1.0 + slope * slope;
  return change / (stretch * sqrt(stretch));
}

}  // namespace flexura

#pragma once

namespace flexura {

/// Beam constraint model of a straight beam (Awtar, Slocum, Sevincer, J. Mech. Des. 129, 2007), in
/// the mixed form of which every one of its relations is a derivative. Lengths by L, forces by
/// EI/L^2, moments by EI/L; delta is the end's transverse displacement, theta its rotation, p the
/// axial force (tension +):
///     H = 1/2 d.(K0 + p K1 + p^2 K2) d - compliance p^2/2,  d = (delta, theta),
/// with transverse force and moment dH/dd and axial displacement -dH/dp. `compliance` is the axial
/// one, I/(A L^2), which is (t/L)^2/12 of a rectangle. K0, K1 and K2 are the Taylor series of the
/// beam under axial force.
template <class Scalar>
Scalar beam_constraint_potential(const Scalar& delta, const Scalar& theta, const Scalar& p,
                                 double compliance) {
  const Scalar dd = delta * delta;
  const Scalar dt = delta * theta;
  const Scalar tt = theta * theta;
  const Scalar elastic = 6.0 * dd - 6.0 * dt + 2.0 * tt;
  const Scalar load = 0.6 * dd - 0.1 * dt + (1.0 / 15.0) * tt;
  const Scalar load_squared =
      (-1.0 / 1400.0) * dd + (1.0 / 1400.0) * dt - (11.0 / 12600.0) * tt - 0.5 * compliance;
  return elastic + p * (load + p * load_squared);
}

}  // namespace flexura

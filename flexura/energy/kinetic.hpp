#pragma once

namespace flexura {

/// Inertia of a section per length: rho A and rho I.
struct SectionInertia {
  double mass = 0.0;
  double rotary = 0.0;
};

/// Kinetic energy per length of a section whose centroid moves with (vx, vy).
template <class Scalar>
Scalar translation_energy(const Scalar& vx, const Scalar& vy, const SectionInertia& section) {
  return (0.5 * section.mass) * (vx * vx + vy * vy);
}

/// Kinetic energy per length of a section that turns; (dx, dy) is the velocity of a unit vector
/// fixed to it. With the vector along the section's normal that is Timoshenko's rotary inertia,
/// with one along the deformed axis (which shears against it) Rayleigh's.
template <class Scalar>
Scalar rotary_energy(const Scalar& dx, const Scalar& dy, const SectionInertia& section) {
  return (0.5 * section.rotary) * (dx * dx + dy * dy);
}

}  // namespace flexura

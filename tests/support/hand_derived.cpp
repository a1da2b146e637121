#include "tests/support/hand_derived.hpp"

#include <algorithm>
#include <cmath>

#include "flexura/modelings/beam_common.hpp"

namespace flexura::testing {

HandDerivedExact::HandDerivedExact(const FlexureProperties& flexure, int modes)
    : axial_compliance_(flexure.axial_compliance),
      shear_compliance_(flexure.shear_compliance),
      field_(constant_section_field(flexure, {flexure.axis.breaks(), modes})) {}

/// With t = (c, s), n = (-s, c): d(f.t)/d(theta) = f.n and d(f.n)/d(theta) = -f.t. For
///     phi = -f.t - 1/2 [a (f.t)^2 + b (f.n)^2],   p = 1 + (a - b) f.t,
/// phi_theta = -f.n p, phi_f = -(1 + a f.t) t - b f.n n, and so on below.
TipResponse HandDerivedExact::linearize(const Eigen::Vector3d& load, const double* internal,
                                        double* scratch) const {
  using Jet = Jet2<3, Pack2>;
  const double a = axial_compliance_;
  const double b = shear_compliance_;
  const double d = a - b;
  const auto derivatives = [=](std::size_t, const Jet& theta, const Jet& fx, const Jet& fy) {
    const Pack2 c = cos_of(theta.value);
    const Pack2 s = sin_of(theta.value);
    const Pack2 ft = fx.value * c + fy.value * s;
    const Pack2 fn = fy.value * c - fx.value * s;
    const Pack2 p = 1.0 + d * ft;
    const Pack2 stretch = 1.0 + a * ft;
    const Pack2 gamma = b * fn;
    Jet phi(-ft - 0.5 * (a * ft * ft + gamma * fn));
    phi.gradient = {-fn * p, gamma * s - stretch * c, -stretch * s - gamma * c};
    phi.hessian = {ft * p - d * fn * fn,     // theta theta
                   s * p - d * fn * c,       // fx theta
                   -a * c * c - b * s * s,   // fx fx
                   -c * p - d * fn * s,      // fy theta
                   -d * c * s,               // fy fx
                   -a * s * s - b * c * c};  // fy fy
    return phi;
  };
  return linearize_angle_field(field_, derivatives, load, internal, scratch);
}

HandDerivedBeam::HandDerivedBeam(const FlexureProperties& flexure, int elements, int order)
    : ea_(1.0 / flexure.axial_compliance),
      ga_(1.0 / flexure.shear_compliance),
      ei_(flexure.bending_stiffness),
      mesh_(flexure.axis, elements, order),
      chord_(flexure.axis.position(mesh_.length) - flexure.axis.position(0.0)) {}

/// With r' = (dx, dy), N = EA eps, V = GA gamma, the forces in global axes are
///     q = N t + V n,  their rate by r' is  C = EA t t^T + GA n n^T,  by theta
///     g = EA gamma t - GA (1 + eps) n + N n - V t,  where 1 + eps = r'.t (eps + stretch);
/// the moment's: m = N gamma - V (r'.t), m_theta = EA gamma^2 + GA (r'.t)^2 - N (r'.t) - V gamma.
double HandDerivedBeam::add_point(std::size_t element, std::size_t gauss, const double* y,
                                  double* residual, double* band) const {
  const std::size_t per = mesh_.order + 1;
  const double* n = mesh_.shape.data() + gauss * per;
  const double* d = mesh_.slope.data() + gauss * per;
  const BeamMesh::GaussPoint& point = mesh_.points[element * mesh_.order + gauss];
  const std::size_t first = element * mesh_.order;  // node
  const double length = mesh_.length;

  double dx = point.tangent.x, dy = point.tangent.y, theta = point.angle, kappa = 0.0;
  for (std::size_t a = first == 0 ? 1 : 0; a < per; ++a) {
    const double* node = y + 3 * (first + a - 1);
    dx += length * d[a] * node[0];
    dy += length * d[a] * node[1];
    theta += n[a] * node[2];
    kappa += d[a] * node[2];
  }
  const double c = std::cos(theta), s = std::sin(theta);
  const double along = dx * c + dy * s;
  const double gamma = dy * c - dx * s;
  const double eps = along - point.stretch;
  const double w = point.weight;
  const double ea = w * ea_, ga = w * ga_, ei = w * ei_;
  const double axial = ea * eps, shear = ga * gamma, moment = ei * kappa;
  const double qx = length * (axial * c - shear * s);
  const double qy = length * (axial * s + shear * c);
  const double qt = axial * gamma - shear * along;
  const double cxx = length * length * (ea * c * c + ga * s * s);
  const double cxy = length * length * (ea - ga) * c * s;
  const double cyy = length * length * (ea * s * s + ga * c * c);
  const double gt = ea * gamma - shear;
  const double gn = axial - ga * along;
  const double gx = length * (gt * c - gn * s);
  const double gy = length * (gt * s + gn * c);
  const double mt = ea * gamma * gamma + ga * along * along - axial * along - shear * gamma;

  const std::size_t stride = width() + 1;
  for (std::size_t a = first == 0 ? 1 : 0; a < per; ++a) {
    const double da = d[a], na = n[a];
    const std::size_t i = 3 * (first + a - 1);
    residual[4 * i] += da * qx;
    residual[4 * (i + 1)] += da * qy;
    residual[4 * (i + 2)] += na * qt + da * moment;
    double* row0 = band + i * stride + width() - i;  // row0[c] is entry (i, c)
    double* row1 = row0 + stride - 1;
    double* row2 = row1 + stride - 1;
    for (std::size_t b = first == 0 ? 1 : 0; b <= a; ++b) {
      const double dd = da * d[b], dn = da * n[b], nd = na * d[b];
      const std::size_t j = 3 * (first + b - 1);
      row0[j] += dd * cxx;
      row1[j] += dd * cxy;
      row1[j + 1] += dd * cyy;
      row2[j] += nd * gx;
      row2[j + 1] += nd * gy;
      row2[j + 2] += na * n[b] * mt + dd * ei;
      if (b == a) continue;
      row0[j + 1] += dd * cxy;
      row0[j + 2] += dn * gx;
      row1[j + 2] += dn * gy;
    }
  }
  return 0.5 * (axial * eps + shear * gamma + moment * kappa);
}

TipResponse HandDerivedBeam::linearize(const Eigen::Vector3d& load, const double* internal,
                                       double* scratch) const {
  const std::size_t m = internal_size();
  std::fill_n(scratch, scratch_size(), 0.0);
  TipResponse response;
  for (std::size_t e = 0; e < mesh_.elements; ++e)
    for (std::size_t g = 0; g < mesh_.order; ++g)
      response.strain_energy += add_point(e, g, internal, scratch, scratch + 4 * m);
  eliminate_displacements({m, width(), m - 3, mesh_.length, chord_}, load, internal, scratch,
                          response);
  return response;
}

}  // namespace flexura::testing

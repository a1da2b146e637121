#include "flexura/modelings/flexure_properties.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "flexura/core/quadrature.hpp"
#include "flexura/modelings/link_compliance.hpp"

namespace flexura {
namespace {

/// Integrals of 1/I, 1/A and 1/A_s over [a, b] by one Gauss rule.
std::array<double, 3> integrate(const Section& shape, double length, double a, double b) {
  const QuadratureRule& rule = gauss_legendre(12);
  std::array<double, 3> sum{};
  for (std::size_t g = 0; g < rule.nodes.size(); ++g) {
    const double half = 0.5 * (b - a);
    const SectionProperties p = section_properties(shape, a + half * (1.0 + rule.nodes[g]), length);
    sum[0] += half * rule.weights[g] / p.second_moment;
    sum[1] += half * rule.weights[g] / p.area;
    sum[2] += half * rule.weights[g] / p.shear_area;
  }
  return sum;
}

/// Halves intervals until halving them once more changes nothing.
struct Grading {
  const Section& shape;
  double length;
  std::array<double, 3> total;
  std::vector<double> breaks;

  void add(double a, double b, const std::array<double, 3>& whole, int depth) {
    constexpr double rounding = 1e-14;
    constexpr int deepest = 40;
    const double middle = 0.5 * (a + b);
    const auto left = integrate(shape, length, a, middle);
    const auto right = integrate(shape, length, middle, b);
    bool good = true;
    for (std::size_t i = 0; i < 3; ++i)
      good = good && std::abs(left[i] + right[i] - whole[i]) <= rounding * total[i];
    if (good || depth == deepest) {
      breaks.push_back(b);
      return;
    }
    add(a, middle, left, depth + 1);
    add(middle, b, right, depth + 1);
  }
};

std::vector<double> graded_breaks(const Section& shape, double length) {
  const std::vector<double> kinks = section_breaks(shape, length);
  Grading grading{shape, length, {}, {0.0}};
  std::vector<std::array<double, 3>> parts;
  for (std::size_t k = 0; k + 1 < kinks.size(); ++k) {
    parts.push_back(integrate(shape, length, kinks[k], kinks[k + 1]));
    for (std::size_t i = 0; i < 3; ++i) grading.total[i] += parts.back()[i];
  }
  for (std::size_t k = 0; k + 1 < kinks.size(); ++k)
    grading.add(kinks[k], kinks[k + 1], parts[k], 0);
  return grading.breaks;
}

}  // namespace

FlexureProperties::Local FlexureProperties::at(double s) const {
  if (!varying) return {bending_stiffness, axial_compliance, shear_compliance};
  const SectionProperties section = section_properties(varying->shape, s, axis.length());
  return {varying->youngs_modulus * section.second_moment,
          axial_compliance > 0.0 ? 1.0 / (varying->youngs_modulus * section.area) : 0.0,
          shear_compliance > 0.0 ? 1.0 / (varying->shear_modulus * section.shear_area) : 0.0};
}

Vec2 FlexureProperties::load_at(double s) const {
  const double local = varying ? section_properties(varying->shape, s, axis.length()).area : area;
  return field.per_length + local * field.per_volume;
}

Vec2 FlexureProperties::load_ahead(double s) const {
  const double length = axis.length();
  if (!varying) return (length - s) * (field.per_length + area * field.per_volume);
  const QuadratureRule& rule = gauss_legendre(12);
  double volume = 0.0;
  for (std::size_t k = 0; k + 1 < varying->breaks.size(); ++k) {
    const double a = std::max(s, varying->breaks[k]);
    const double half = 0.5 * (varying->breaks[k + 1] - a);
    if (half <= 0.0) continue;
    for (std::size_t g = 0; g < rule.nodes.size(); ++g)
      volume += half * rule.weights[g] *
                section_properties(varying->shape, a + half * (1.0 + rule.nodes[g]), length).area;
  }
  return (length - s) * field.per_length + volume * field.per_volume;
}

std::vector<double> FlexureProperties::smooth_breaks() const {
  std::vector<double> breaks = axis.breaks();
  if (!varying) return breaks;
  breaks.insert(breaks.end(), varying->breaks.begin(), varying->breaks.end());
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  return breaks;
}

FlexureProperties flexure_properties(const Model& model, const Flexure& flexure, bool axial,
                                     bool shear) {
  const Material& material = model.materials[flexure.material];
  const Section shape = section_of(model, flexure);
  const SectionProperties section = section_properties(shape);
  const double e = material.youngs_modulus;
  const double g = e / (2.0 * (1.0 + material.poissons_ratio));
  FlexureProperties properties{AxisCurve(flexure.axis), e * section.second_moment,
                               axial ? 1.0 / (e * section.area) : 0.0,
                               shear ? 1.0 / (g * section.shear_area) : 0.0};
  properties.area = section.area;
  if (flexure.link) {
    properties.compliance = link_compliance(*flexure.link, material);
    properties.bending_stiffness = properties.axis.length() / (*properties.compliance)(2, 2);
  }
  if (section_varies(shape)) {
    const double length = properties.axis.length();
    VaryingSection varying{shape, e, g, graded_breaks(shape, length)};
    std::array<double, 3> total{};
    for (std::size_t k = 0; k + 1 < varying.breaks.size(); ++k) {
      const auto part = integrate(shape, length, varying.breaks[k], varying.breaks[k + 1]);
      for (std::size_t i = 0; i < 3; ++i) total[i] += part[i] / length;
    }
    properties.bending_stiffness = e / total[0];
    if (axial) properties.axial_compliance = total[1] / e;
    if (shear) properties.shear_compliance = total[2] / g;
    properties.varying = std::move(varying);
  }
  return properties;
}

}  // namespace flexura

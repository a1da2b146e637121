#include <algorithm>
#include <cmath>

#include "flexura/core/quadrature.hpp"
#include "flexura/modelings/linkage_links.hpp"

namespace flexura {
namespace {

constexpr int gauss_points = 4;        // the square of a cubic
constexpr int stations_per_link = 41;  // at least

/// Shape functions of an element of length L at x in [0, 1]; `shear`: 12 EI/(GA_s L^2).
/// Columns: deflection and rotation of the first node, then of the second.
struct Shapes {
  Eigen::RowVector4d deflection, slope, rotation, curvature;
};
Shapes shapes_at(double x, double length, double shear) {
  const double d = 1.0 + shear, L = length;
  Shapes at;
  at.deflection << 1 + shear * (1 - x) - 3 * x * x + 2 * x * x * x,
      L * (x + 0.5 * shear * (x - x * x) - 2 * x * x + x * x * x),
      shear * x + 3 * x * x - 2 * x * x * x, L * (-0.5 * shear * (x - x * x) - x * x + x * x * x);
  at.slope << (-shear - 6 * x + 6 * x * x) / L, 1 + 0.5 * shear * (1 - 2 * x) - 4 * x + 3 * x * x,
      (shear + 6 * x - 6 * x * x) / L, -0.5 * shear * (1 - 2 * x) - 2 * x + 3 * x * x;
  at.rotation << 6 * (x * x - x) / L, 1 + shear * (1 - x) - 4 * x + 3 * x * x, 6 * (x - x * x) / L,
      shear * x - 2 * x + 3 * x * x;
  at.curvature << (12 * x - 6) / (L * L), (-4 - shear + 6 * x) / L, (6 - 12 * x) / (L * L),
      (shear - 2 + 6 * x) / L;
  at.deflection /= d;
  at.slope /= d;
  at.rotation /= d;
  at.curvature /= d;
  return at;
}

/// Bending moment at x of a clamped element under a transverse load that goes from p0 to p1, by
/// both: what the cubic leaves out.
Eigen::RowVector2d clamped_moment(double x, double length) {
  const double even = (1.0 - 6.0 * x + 6.0 * x * x) / 12.0;
  const double rising = x * x * x / 6.0 - 3.0 * x / 20.0 + 1.0 / 30.0;
  return length * length * Eigen::RowVector2d{even - rising, rising};
}

class BeamLink {
 public:
  BeamLink(const FlexureProperties& flexure, const FlexureInertia& inertia, int elements)
      : flexure_(flexure), inertia_(inertia), elements_(elements) {}
  ElasticLink make();

 private:
  struct Element {
    Vec2 start, along, across;
    double length = 0.0;
    double shear = 0.0;
    Eigen::Index first[2] = {};
    double s = 0.0;  // arc length at the start, and its own
    double arc = 0.0;
  };
  Eigen::Index node_unknown(int node) const {
    return node == 0 ? 0 : node == elements_ ? 3 : 6 + 3 * (node - 1);
  }
  Element element(int e) const;
  Eigen::RowVectorXd axial_row(const Element& e, double at_start, double at_end) const;
  Eigen::RowVectorXd bending_row(const Element& e, const Eigen::RowVector4d& shape) const;
  FlexureProperties::Local local(const Element& e, double x) const {
    return flexure_.at(std::min(e.s + x * e.arc, flexure_.axis.length()));
  }
  SectionProperties section(const Element& e, double x) const {
    return section_properties(inertia_.shape, e.s + x * e.arc, flexure_.axis.length());
  }
  void add_element(const Element& e);
  ElasticLink::Reading fibre_strain(int index, double x) const;
  ElasticLink::Reading axial_strain(int index, double x) const;
  void add_station(int index, double x);
  void read_middle();

  const FlexureProperties& flexure_;
  const FlexureInertia& inertia_;
  int elements_;
  ElasticLink link_;
};

BeamLink::Element BeamLink::element(int e) const {
  Element at;
  const double whole = flexure_.axis.length();
  at.arc = whole / elements_;
  at.s = e * at.arc;
  at.start = flexure_.axis.position(at.s);
  const Vec2 chord = flexure_.axis.position(e + 1 == elements_ ? whole : at.s + at.arc) - at.start;
  at.length = norm(chord);
  at.along = (1.0 / at.length) * chord;
  at.across = perp(at.along);
  at.first[0] = node_unknown(e);
  at.first[1] = node_unknown(e + 1);
  const FlexureProperties::Local middle = local(at, 0.5);
  at.shear = 12.0 * middle.bending_stiffness * middle.shear_compliance / (at.length * at.length);
  return at;
}

Eigen::RowVectorXd BeamLink::axial_row(const Element& e, double at_start, double at_end) const {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(link_.size());
  for (int i = 0; i < 2; ++i) {
    const double share = i == 0 ? at_start : at_end;
    row[e.first[i]] += share * e.along.x;
    row[e.first[i] + 1] += share * e.along.y;
  }
  return row;
}

Eigen::RowVectorXd BeamLink::bending_row(const Element& e, const Eigen::RowVector4d& shape) const {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(link_.size());
  for (int i = 0; i < 2; ++i) {
    row[e.first[i]] += shape[2 * i] * e.across.x;
    row[e.first[i] + 1] += shape[2 * i] * e.across.y;
    row[e.first[i] + 2] += shape[2 * i + 1];
  }
  return row;
}

void BeamLink::add_element(const Element& e) {
  const QuadratureRule& rule = gauss_legendre(gauss_points);
  const Eigen::RowVectorXd stretch = axial_row(e, -1.0 / e.length, 1.0 / e.length);
  for (std::size_t g = 0; g < rule.nodes.size(); ++g) {
    const double x = 0.5 * (1.0 + rule.nodes[g]);
    const double length = 0.5 * rule.weights[g] * e.length;
    const Shapes at = shapes_at(x, e.length, e.shear);
    const FlexureProperties::Local stiff = local(e, x);
    const Eigen::RowVectorXd bend = bending_row(e, at.curvature);
    const Eigen::RowVectorXd rotation = bending_row(e, at.rotation);
    const Eigen::RowVectorXd deflection = bending_row(e, at.deflection);
    link_.stiffness += length / stiff.axial_compliance * stretch.transpose() * stretch;
    link_.stiffness += length * stiff.bending_stiffness * bend.transpose() * bend;
    if (e.shear > 0.0) {
      const Eigen::RowVectorXd strain = bending_row(e, at.slope - at.rotation);
      link_.stiffness += length / stiff.shear_compliance * strain.transpose() * strain;
    }
    const SectionInertia mass = inertia_.at(std::min(e.s + x * e.arc, flexure_.axis.length()));
    // the axis may be longer than its chord: mass is that of the axis
    const double axis = 0.5 * rule.weights[g] * e.arc;
    const auto k = static_cast<Eigen::Index>(link_.places.size());
    link_.places.push_back(e.start + (x * e.length) * e.along);
    link_.masses.push_back(axis * mass.mass);
    const Eigen::RowVectorXd along = axial_row(e, 1.0 - x, x);
    link_.slopes.row(2 * k) = e.along.x * along + e.across.x * deflection;
    link_.slopes.row(2 * k + 1) = e.along.y * along + e.across.y * deflection;
    link_.slices.push_back({rotation, stretch / stiff.axial_compliance, length,
                            inertia_.rotary ? axis * mass.rotary : 0.0});
  }
  ElasticLink::Element element{{e.start, e.start + e.length * e.along},
                               e.across,
                               {},
                               inertia_.at(e.s + 0.5 * e.arc).mass * e.arc / e.length};
  for (int end = 0; end < 2; ++end) {
    element.displacement[end] = Eigen::MatrixXd::Zero(2, link_.size());
    element.displacement[end](0, e.first[end]) = 1.0;
    element.displacement[end](1, e.first[end] + 1) = 1.0;
  }
  link_.elements.push_back(std::move(element));
}

/// -c w'', on the side of the normal, which is that of +n.
ElasticLink::Reading BeamLink::fibre_strain(int index, double x) const {
  const Element e = element(index);
  const double fibre = 0.5 * section(e, x).depth;
  return {-fibre * bending_row(e, shapes_at(x, e.length, e.shear).curvature),
          {{static_cast<std::size_t>(index),
            -fibre / local(e, x).bending_stiffness * clamped_moment(x, e.length)}}};
}

ElasticLink::Reading BeamLink::axial_strain(int index, double /*x*/) const {
  const Element e = element(index);
  return {axial_row(e, -1.0 / e.length, 1.0 / e.length), {}};
}

void BeamLink::add_station(int index, double x) {
  const Element e = element(index);
  const Eigen::RowVectorXd along = axial_row(e, 1.0 - x, x);
  const Eigen::RowVectorXd across = bending_row(e, shapes_at(x, e.length, e.shear).deflection);
  ElasticLink::Station station;
  station.s = e.s + x * e.arc;
  station.place = e.start + (x * e.length) * e.along;
  station.displacement.resize(2, link_.size());
  station.displacement.row(0) = e.along.x * along + e.across.x * across;
  station.displacement.row(1) = e.along.y * along + e.across.y * across;
  const FlexureProperties::Local stiff = local(e, x);
  const double modulus = 1.0 / (stiff.axial_compliance * section(e, x).area);
  const auto scaled = [&](ElasticLink::Reading reading) {
    reading.by_u *= modulus;
    for (auto& part : reading.inertia) part.by_load *= modulus;
    return reading;
  };
  station.bending_stress = scaled(fibre_strain(index, x));
  station.axial_stress = scaled(axial_strain(index, x));
  link_.stations.push_back(std::move(station));
}

/// At mid-length; between two elements the mean of both.
void BeamLink::read_middle() {
  const auto mean = [&](const auto& read) {
    if (elements_ % 2 == 1) return read(elements_ / 2, 0.5);
    ElasticLink::Reading left = read(elements_ / 2 - 1, 1.0), right = read(elements_ / 2, 0.0);
    left.by_u = 0.5 * (left.by_u + right.by_u);
    left.inertia.insert(left.inertia.end(), right.inertia.begin(), right.inertia.end());
    for (auto& part : left.inertia) part.by_load *= 0.5;
    return left;
  };
  link_.strain = mean([&](int e, double x) { return fibre_strain(e, x); });
  link_.axial_strain = mean([&](int e, double x) { return axial_strain(e, x); });
  const int middle = elements_ / 2;
  const Element e = element(middle);
  const double x = elements_ % 2 == 1 ? 0.5 : 0.0;
  const Vec2 chord = link_.action - link_.base;
  const Vec2 normal = (1.0 / norm(chord)) * perp(chord);
  const Eigen::RowVectorXd along = axial_row(e, 1.0 - x, x);
  const Eigen::RowVectorXd across = bending_row(e, shapes_at(x, e.length, e.shear).deflection);
  Eigen::RowVectorXd row = dot(e.along, normal) * along + dot(e.across, normal) * across;
  for (const Eigen::Index end : {0, 3}) {
    row[end] -= 0.5 * normal.x;
    row[end + 1] -= 0.5 * normal.y;
  }
  link_.deflection = {row, {}};
}

ElasticLink BeamLink::make() {
  const Eigen::Index n = 6 + 3 * (elements_ - 1);
  link_.base = flexure_.axis.position(0.0);
  link_.action = flexure_.axis.position(flexure_.axis.length());
  link_.stiffness = Eigen::MatrixXd::Zero(n, n);
  link_.slopes = Eigen::MatrixXd::Zero(2 * gauss_points * elements_, n);
  for (int e = 0; e < elements_; ++e) add_element(element(e));
  for (Eigen::Index node = 0; node < n; node += 3) link_.pairs.push_back(node);
  const int per_element = std::max(2, (stations_per_link - 1 + elements_ - 1) / elements_);
  for (int e = 0; e < elements_; ++e)
    for (int k = e == 0 ? 0 : 1; k <= per_element; ++k)
      add_station(e, static_cast<double>(k) / per_element);
  read_middle();
  return std::move(link_);
}

}  // namespace

ElasticLink make_beam_link(const FlexureProperties& flexure, const FlexureInertia& inertia,
                           int elements) {
  return BeamLink(flexure, inertia, elements).make();
}

}  // namespace flexura

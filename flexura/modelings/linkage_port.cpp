#include <Eigen/Dense>
#include <algorithm>

#include "flexura/assembly/motion_port.hpp"
#include "flexura/modelings/linkage_links.hpp"
#include "flexura/modelings/linkage_shapes.hpp"

namespace flexura {
namespace {

constexpr double small = 1e-5;  // internal unknowns are of order one: results are linear up to that

/// Weights of Simpson's rule for an odd number of even stations.
double simpson(std::size_t k, std::size_t count) {
  return (k == 0 || k + 1 == count ? 1.0 : k % 2 == 1 ? 4.0 : 2.0) / 3.0;
}

/// Second derivatives, places and tips of a port as drawn.
struct Drawn {
  Eigen::MatrixXd stiffness;  // by y
  Eigen::MatrixXd slopes;     // of all mass points by y, two rows each
  Eigen::MatrixXd tip;        // 3 rows
  std::vector<Vec2> places;
};

Drawn drawn_of(const MotionPort& port) {
  const auto m = static_cast<Eigen::Index>(port.internal_size());
  MemberWork work = sized_work(port);
  const std::vector<double> rest(port.internal_size(), 0.0);
  port.evaluate(Eigen::Vector3d::Zero(), rest.data(), rest.data(), rest.data(), work);
  Drawn drawn{Eigen::MatrixXd::Zero(m, m),
              Eigen::MatrixXd::Zero(2 * static_cast<Eigen::Index>(port.points().size()), m),
              Eigen::MatrixXd(3, m), work.places};
  for (Eigen::Index i = 0; i < m; ++i)
    for (Eigen::Index k = 0; k < 3; ++k)
      drawn.tip(k, i) = -work.columns[static_cast<std::size_t>(4 * i + 1 + k)];
  port.linearize(Eigen::Vector3d::Zero(), rest.data(), nullptr, work);
  const BandLayout layout = port.layout();
  for (std::size_t i = 0; i < layout.n; ++i)
    for (std::size_t j = i > layout.width ? i - layout.width : 0; j <= i; ++j) {
      const double entry = layout.row(work.tangent.data(), i)[j];
      drawn.stiffness(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = entry;
      drawn.stiffness(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) = entry;
    }
  std::size_t at = 0;
  for (std::size_t g = 0; g < port.points().size(); ++g)
    for (std::size_t j = 0; j < port.points()[g].count; ++j, ++at) {
      const auto column = static_cast<Eigen::Index>(port.points()[g].first + j);
      drawn.slopes(2 * static_cast<Eigen::Index>(g), column) = work.slopes[at].x;
      drawn.slopes(2 * static_cast<Eigen::Index>(g) + 1, column) = work.slopes[at].y;
    }
  return drawn;
}

class PortLink {
 public:
  PortLink(const FlexureProperties& flexure, const FlexureInertia& inertia,
           const Material& material, const MotionPort& port)
      : flexure_(flexure),
        inertia_(inertia),
        material_(material),
        port_(port),
        drawn_(drawn_of(port)) {}
  ElasticLink make(int most_modes);

 private:
  void find_shapes(int most_modes);
  /// Of the tip against the base section, by u.
  Eigen::Matrix<double, 3, 6> relative() const;
  void add_masses();
  void add_stations();
  /// Rows by u of what `sections` says of every station.
  template <class Read>
  Eigen::MatrixXd rows_of(int count, const Read& read) const;
  std::vector<SectionState> sections_at(const Eigen::VectorXd& y) const {
    return port_.sections(Eigen::Vector3d::Zero(), y.data());
  }

  const FlexureProperties& flexure_;
  const FlexureInertia& inertia_;
  const Material& material_;
  const MotionPort& port_;
  Drawn drawn_;
  Eigen::MatrixXd inside_;  // y by u
  ElasticLink link_;
};

Eigen::Matrix<double, 3, 6> PortLink::relative() const {
  const Vec2 chord = link_.action - link_.base;
  Eigen::Matrix<double, 3, 6> d = Eigen::Matrix<double, 3, 6>::Zero();
  d.leftCols<3>().diagonal().setConstant(-1.0);
  d.rightCols<3>().setIdentity();
  d(0, 2) = chord.y;
  d(1, 2) = -chord.x;
  return d;
}

/// y by the relative displacement of the tip, as a load on it would have it, and by vibrations with
/// the tip held.
void PortLink::find_shapes(int most_modes) {
  const Eigen::Index m = drawn_.stiffness.rows();
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(m, m);
  for (std::size_t g = 0; g < port_.points().size(); ++g) {
    const MassPoint& point = port_.points()[g];
    const auto first = static_cast<Eigen::Index>(point.first);
    const auto count = static_cast<Eigen::Index>(point.count);
    const auto rows = drawn_.slopes.block(2 * static_cast<Eigen::Index>(g), first, 2, count);
    mass.block(first, first, count, count) += point.inertia * rows.transpose() * rows;
  }
  const int count = std::min(most_modes, static_cast<int>(m) - 3);
  const HeldShapes shapes = held_shapes(drawn_.stiffness, mass, drawn_.tip, count);
  inside_.resize(m, 6 + shapes.vibrations.cols());
  inside_.leftCols<6>() = shapes.by_tip * relative();
  inside_.rightCols(shapes.vibrations.cols()) = shapes.vibrations;
}

void PortLink::add_masses() {
  const Eigen::Index n = link_.size();
  const auto& points = port_.points();
  std::vector<std::size_t> of_places;
  for (std::size_t g = 0; g < points.size(); ++g) {
    const auto rows = drawn_.slopes.middleRows<2>(2 * static_cast<Eigen::Index>(g));
    if (!points[g].direction) {
      of_places.push_back(g);
      continue;
    }
    const Vec2 along = perp(drawn_.places[g]);
    Eigen::RowVectorXd rotation = (along.x * rows.row(0) + along.y * rows.row(1)) * inside_;
    rotation[2] += 1.0;
    link_.slices.push_back({rotation, Eigen::RowVectorXd::Zero(n), 0.0, points[g].inertia});
  }
  link_.slopes.resize(2 * static_cast<Eigen::Index>(of_places.size()), n);
  for (std::size_t k = 0; k < of_places.size(); ++k) {
    const std::size_t g = of_places[k];
    auto rows = link_.slopes.middleRows<2>(2 * static_cast<Eigen::Index>(k));
    rows = drawn_.slopes.middleRows<2>(2 * static_cast<Eigen::Index>(g)) * inside_;
    rows.leftCols<2>() += Eigen::Matrix2d::Identity();
    const Vec2 place = drawn_.places[g];
    rows(0, 2) -= place.y;
    rows(1, 2) += place.x;
    link_.places.push_back(link_.base + place);
    link_.masses.push_back(points[g].inertia);
  }
}

template <class Read>
Eigen::MatrixXd PortLink::rows_of(int count, const Read& read) const {
  Eigen::MatrixXd rows(count, link_.size());
  for (Eigen::Index j = 0; j < link_.size(); ++j) {
    const double largest = inside_.col(j).lpNorm<Eigen::Infinity>();
    rows.col(j).setZero();
    if (largest == 0.0) continue;
    const double h = small / largest;
    const auto ahead = sections_at(h * inside_.col(j)), behind = sections_at(-h * inside_.col(j));
    for (int i = 0; i < count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      rows(i, j) = (read(ahead[k]) - read(behind[k])) / (2.0 * h);
    }
  }
  return rows;
}

void PortLink::add_stations() {
  const Eigen::Index n = link_.size();
  const auto drawn = sections_at(Eigen::VectorXd::Zero(inside_.rows()));
  const int count = static_cast<int>(drawn.size());
  const Eigen::MatrixXd x = rows_of(count, [](const auto& s) { return s.pose.position.x; });
  const Eigen::MatrixXd y = rows_of(count, [](const auto& s) { return s.pose.position.y; });
  const Eigen::MatrixXd turn = rows_of(count, [](const auto& s) { return s.pose.rotation; });
  const Eigen::MatrixXd moment = rows_of(count, [](const auto& s) { return s.bending_moment; });
  const Eigen::MatrixXd axial = rows_of(count, [](const auto& s) { return s.axial_force; });
  const double whole = flexure_.axis.length();
  const double apart = whole / static_cast<double>(drawn.size() - 1);  // stations are even
  const std::size_t middle = drawn.size() / 2;
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    ElasticLink::Station station;
    station.s = static_cast<double>(k) * apart;
    const SectionProperties section = section_properties(inertia_.shape, station.s, whole);
    station.place = link_.base + drawn[k].pose.position;
    station.displacement.resize(2, n);
    station.displacement << x.row(i), y.row(i);
    station.displacement.leftCols<2>() += Eigen::Matrix2d::Identity();
    station.displacement(0, 2) -= drawn[k].pose.position.y;
    station.displacement(1, 2) += drawn[k].pose.position.x;
    station.bending_stress = {-0.5 * section.depth / section.second_moment * moment.row(i), {}};
    station.axial_stress = {axial.row(i) / section.area, {}};
    link_.stations.push_back(std::move(station));
    Eigen::RowVectorXd rotation = turn.row(i);
    rotation[2] += 1.0;
    link_.slices.push_back({rotation, axial.row(i), simpson(k, drawn.size()) * apart, 0.0});
  }
  const auto i = static_cast<Eigen::Index>(middle);
  const FlexureProperties::Local local = flexure_.at(0.5 * whole);
  const SectionProperties section = section_properties(inertia_.shape, 0.5 * whole, whole);
  link_.strain = {-0.5 * section.depth / local.bending_stiffness * moment.row(i), {}};
  link_.axial_strain = {axial.row(i) * local.axial_compliance, {}};
  const Vec2 chord = link_.action - link_.base;
  const Vec2 normal = (1.0 / norm(chord)) * perp(chord);
  const auto& displacement = link_.stations[middle].displacement;
  Eigen::RowVectorXd row = normal.x * displacement.row(0) + normal.y * displacement.row(1);
  for (const Eigen::Index end : {0, 3}) {
    row[end] -= 0.5 * normal.x;
    row[end + 1] -= 0.5 * normal.y;
  }
  link_.deflection = {row, {}};
}

ElasticLink PortLink::make(int most_modes) {
  link_.base = flexure_.axis.position(0.0);
  link_.action = flexure_.axis.position(flexure_.axis.length());
  find_shapes(most_modes);
  const Eigen::MatrixXd stiffness = inside_.transpose() * drawn_.stiffness * inside_;
  link_.stiffness = 0.5 * (stiffness + stiffness.transpose());
  add_masses();
  const std::vector<double> rest(port_.internal_size(), 0.0);
  if (port_.stress_field(rest.data()) && !port_.stress_field(rest.data())->pieces.empty())
    add_plate_readings(link_, port_, material_, inside_);
  else
    add_stations();
  // bodies hold three unknowns of the tip
  link_.whole_size = drawn_.stiffness.rows() + 3;
  link_.pairs = {0, 3};
  return std::move(link_);
}

}  // namespace

ElasticLink make_port_link(const FlexureProperties& flexure, const FlexureInertia& inertia,
                           const Material& material, const MotionPort& port, int most_modes) {
  return PortLink(flexure, inertia, material, port).make(most_modes);
}

}  // namespace flexura

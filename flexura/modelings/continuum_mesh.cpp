#include "flexura/modelings/continuum_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "flexura/core/lagrange.hpp"
#include "flexura/core/quadrature.hpp"

namespace flexura {

StripShape::StripShape(AxisCurve curve, Section of_it)
    : axis(std::move(curve)), section(std::move(of_it)) {}

double StripShape::thickness(double s) const {
  const SectionProperties p = section_properties(section, s, axis.length());
  return std::sqrt(12.0 * p.second_moment / p.area);
}

double StripShape::width(double s) const {
  return section_properties(section, s, axis.length()).area / thickness(s);
}

std::vector<double> StripShape::breaks() const {
  std::vector<double> all = axis.breaks();
  const std::vector<double> own = section_breaks(section, axis.length());
  all.insert(all.end(), own.begin(), own.end());
  std::sort(all.begin(), all.end());
  std::vector<double> breaks{0.0};
  const double same = 1e-9 * axis.length();
  for (const double s : all)
    if (s > breaks.back() + same && s < axis.length() - same) breaks.push_back(s);
  breaks.push_back(axis.length());
  return breaks;
}

LagrangeLine::LagrangeLine(int order) : places_(gauss_lobatto(order + 1).nodes) {}

std::vector<double> LagrangeLine::values(double x) const { return lagrange_values(places_, x); }

std::vector<double> LagrangeLine::slopes(double x) const { return lagrange_slopes(places_, x); }

std::vector<double> through_gauss(std::size_t count, double x) {
  return lagrange_values(gauss_legendre(static_cast<int>(count)).nodes, x);
}

double StripMesh::station(std::size_t column) const {
  const std::size_t p = line.order();
  const std::size_t e = std::min(column / p, along - 1);
  const double half = 0.5 * (stations[e + 1] - stations[e]);
  return stations[e] + half * (1.0 + line.place(column - e * p));
}

std::size_t StripMesh::find(double s, double& xi) const {
  const auto after = std::upper_bound(stations.begin() + 1, stations.end() - 1, s);
  const auto e = static_cast<std::size_t>(after - stations.begin()) - 1;
  xi = std::clamp(2.0 * (s - stations[e]) / (stations[e + 1] - stations[e]) - 1.0, -1.0, 1.0);
  return e;
}

namespace {

/// `count` elements over the pieces between breaks, each of which gets one at least.
std::vector<double> even_stations(const std::vector<double>& breaks, std::size_t count) {
  const std::size_t pieces = breaks.size() - 1;
  std::vector<std::size_t> share(pieces, 1);
  for (std::size_t left = count > pieces ? count - pieces : 0; left > 0; --left) {
    std::size_t longest = 0;
    const auto size = [&](std::size_t k) {
      return (breaks[k + 1] - breaks[k]) / static_cast<double>(share[k]);
    };
    for (std::size_t k = 1; k < pieces; ++k)
      if (size(k) > size(longest) * (1.0 + 1e-12)) longest = k;
    ++share[longest];
  }
  std::vector<double> stations{0.0};
  for (std::size_t k = 0; k < pieces; ++k)
    for (std::size_t i = 1; i <= share[k]; ++i)
      stations.push_back(i == share[k]
                             ? breaks[k + 1]
                             : breaks[k] + (breaks[k + 1] - breaks[k]) * static_cast<double>(i) /
                                               static_cast<double>(share[k]));
  return stations;
}

/// How much an element may take on: turn of the axis, share of the length, and change of the
/// thickness' logarithm.
struct Needs {
  int order = 0;
  int order_across = 0;
  double turn = 0.0;
  double share = 0.0;
  double thickness = 0.0;
};

/// Adds stations behind a until b that share out evenly what an element may take on.
void add_stations(const StripShape& shape, double a, double b, const Needs& needs,
                  std::vector<double>& stations) {
  constexpr int looks = 200;
  std::vector<double> used{0.0};
  const auto place = [&](int k) { return a + (b - a) * k / looks; };
  for (int k = 0; k < looks; ++k) {
    const double from = place(k);
    const double to = place(k + 1);
    const double turned =
        std::abs(shape.axis.tangent_angle(to) - shape.axis.tangent_angle(from)) / needs.turn;
    const double thicker =
        std::abs(std::log(shape.thickness(to) / shape.thickness(from))) / needs.thickness;
    const double longer = (to - from) / (needs.share * shape.axis.length());
    used.push_back(used.back() + std::max({turned, thicker, longer}));
  }
  const auto pieces = static_cast<std::size_t>(std::ceil(used.back() - 1e-9));
  std::size_t k = 0;
  for (std::size_t i = 1; i < pieces; ++i) {
    const double wanted = used.back() * static_cast<double>(i) / static_cast<double>(pieces);
    while (used[k + 1] < wanted) ++k;
    const double share = (wanted - used[k]) / (used[k + 1] - used[k]);
    stations.push_back(place(static_cast<int>(k)) + share * (b - a) / looks);
  }
  stations.push_back(b);
}

/// Short elements at both ends, and breaks between elements.
std::vector<double> graded_stations(const StripShape& shape, const Needs& needs) {
  const double length = shape.axis.length();
  std::vector<double> breaks = shape.breaks();
  const double layer[2] = {shape.thickness(0.0), shape.thickness(length)};
  for (const double multiple : {0.5, 2.0, 6.0}) {
    if (multiple * layer[0] < 0.2 * length) breaks.push_back(multiple * layer[0]);
    if (multiple * layer[1] < 0.2 * length) breaks.push_back(length - multiple * layer[1]);
  }
  std::sort(breaks.begin(), breaks.end());
  std::vector<double> stations{0.0};
  for (const double s : breaks)
    if (s > stations.back() + 1e-3 * std::min(layer[0], layer[1]))
      add_stations(shape, stations.back(), s, needs, stations);
  stations.back() = length;
  if (stations.size() == 2) stations.insert(stations.begin() + 1, 0.5 * length);
  return stations;
}

void place_nodes(StripMesh& mesh, const StripShape& shape) {
  const Vec2 start = shape.axis.position(0.0);
  const std::size_t q = mesh.cross_line.order();
  for (std::size_t c = 0; c < mesh.columns; ++c) {
    const double s = c + 1 == mesh.columns ? mesh.length : mesh.station(c);
    const Vec2 n = perp(unit(shape.axis.tangent_angle(s)));
    const double half = 0.5 * shape.thickness(s);
    for (std::size_t r = 0; r < mesh.rows; ++r) {
      const std::size_t e = std::min(r / q, mesh.across - 1);
      const double along_element = 0.5 * (1.0 + mesh.cross_line.place(r - e * q));
      const double eta =
          2.0 * (static_cast<double>(e) + along_element) / static_cast<double>(mesh.across) - 1.0;
      mesh.nodes.push_back(shape.axis.position(s) - start + eta * half * n);
    }
  }
}

void place_points(StripMesh& mesh) {
  const QuadratureRule& xi = gauss_legendre(static_cast<int>(mesh.line.order()) + 1);
  const QuadratureRule& eta = gauss_legendre(static_cast<int>(mesh.cross_line.order()) + 1);
  for (std::size_t i = 0; i < xi.nodes.size(); ++i) {
    for (std::size_t j = 0; j < eta.nodes.size(); ++j) {
      mesh.points.push_back({xi.nodes[i], eta.nodes[j], xi.weights[i] * eta.weights[j]});
      const auto nx = mesh.line.values(xi.nodes[i]);
      const auto dx = mesh.line.slopes(xi.nodes[i]);
      const auto ny = mesh.cross_line.values(eta.nodes[j]);
      const auto dy = mesh.cross_line.slopes(eta.nodes[j]);
      for (std::size_t a = 0; a < nx.size(); ++a) {
        for (std::size_t b = 0; b < ny.size(); ++b) {
          mesh.values.push_back(nx[a] * ny[b]);
          mesh.by_xi.push_back(dx[a] * ny[b]);
          mesh.by_eta.push_back(nx[a] * dy[b]);
        }
      }
    }
  }
}

void map_points(StripMesh& mesh, const StripShape& shape) {
  mesh.maps.reserve(mesh.along * mesh.across * mesh.points.size());
  for (std::size_t ex = 0; ex < mesh.along; ++ex) {
    const double half = 0.5 * (mesh.stations[ex + 1] - mesh.stations[ex]);
    for (std::size_t ey = 0; ey < mesh.across; ++ey)
      mesh.map_element([&](std::size_t a) { return mesh.nodes[mesh.element_node(ex, ey, a)]; },
                       [&](const StripMesh::Point& point) {
                         return shape.width(mesh.stations[ex] + half * (1.0 + point.xi));
                       });
  }
}

/// What the tolerance needs where the settings do not say, from the convergence of cantilevers and
/// of the arc chain (verification/continuum_test.cpp).
Needs needs_of(double tolerance) {
  if (tolerance > 3e-4) return {4, 2, 0.6, 0.34, 0.7};
  if (tolerance > 1e-5) return {5, 3, 0.5, 0.25, 0.5};
  return {6, 4, 0.5, 0.2, 0.35};
}

/// One for strips; more where the outline is deep for its length, as beside a notch, since stress
/// leaves the corners there.
int elements_across(const StripShape& shape) {
  constexpr int looks = 40;
  double deepest = 0.0;
  for (int k = 0; k <= looks; ++k)
    deepest = std::max(deepest, shape.thickness(shape.axis.length() * k / looks));
  return std::clamp(static_cast<int>(std::ceil(3.0 * deepest / shape.axis.length())), 1, 4);
}

}  // namespace

StripMesh make_strip_mesh(const StripShape& shape, const ContinuumSettings& settings,
                          double tolerance) {
  const Needs needs = needs_of(tolerance);
  StripMesh mesh;
  const int order = settings.order.value_or(settings.elements ? 2 : needs.order);
  const int order_across =
      settings.order_across.value_or(settings.order ? order : std::min(order, needs.order_across));
  mesh.line = LagrangeLine(order);
  mesh.cross_line = LagrangeLine(order_across);
  mesh.stations = settings.elements
                      ? even_stations(shape.breaks(), static_cast<std::size_t>(*settings.elements))
                      : graded_stations(shape, needs);
  mesh.along = mesh.stations.size() - 1;
  mesh.across = static_cast<std::size_t>(
      settings.across.value_or(order_across == 1 ? 8 : elements_across(shape)));
  mesh.columns = mesh.along * static_cast<std::size_t>(order) + 1;
  mesh.rows = mesh.across * static_cast<std::size_t>(order_across) + 1;
  mesh.length = shape.axis.length();
  mesh.chord = shape.axis.position(mesh.length) - shape.axis.position(0.0);
  place_nodes(mesh, shape);
  place_points(mesh);
  map_points(mesh, shape);
  return mesh;
}

}  // namespace flexura

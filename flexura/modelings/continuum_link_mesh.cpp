#include "flexura/modelings/continuum_link_mesh.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace flexura {
namespace {

/// Where the a-th node of a block's element stands in the mesh's element.
std::size_t own_node(ElementKind kind, std::size_t a) {
  constexpr std::size_t columns[4] = {0, 3, 1, 2};  // (-1, -1), (-1, 1), (1, -1), (1, 1)
  return kind == ElementKind::quad4 ? columns[a] : a;
}

}  // namespace

ElementTables make_tables(ElementKind kind, std::vector<ElementPoint> points) {
  ElementTables tables;
  tables.points = std::move(points);
  for (const ElementPoint& point : tables.points) {
    const ShapeValues shape = shape_values(kind, {point.xi, point.eta});
    for (std::size_t a = 0; a < nodes_of(kind); ++a) {
      const std::size_t own = own_node(kind, a);
      tables.values.push_back(shape.values[own]);
      tables.by_xi.push_back(shape.by_xi[own]);
      tables.by_eta.push_back(shape.by_eta[own]);
    }
  }
  return tables;
}

std::vector<Vec2> block_places(ElementKind kind) {
  const std::vector<Vec2> own = reference_nodes(kind);
  std::vector<Vec2> places;
  for (std::size_t a = 0; a < own.size(); ++a) places.push_back(own[own_node(kind, a)]);
  return places;
}

std::vector<double> through_points(ElementKind kind, Vec2 place) {
  if (kind == ElementKind::triangle3) return {1.0};
  if (kind == ElementKind::triangle6) {  // points at (1, 1), (4, 1) and (1, 4) sixths
    const double x = 2.0 * place.x - 1.0 / 3.0, y = 2.0 * place.y - 1.0 / 3.0;
    return {1.0 - x - y, x, y};
  }
  const std::size_t count = kind == ElementKind::quad4 ? 2 : 3;
  std::vector<double> values;
  for (const double x : through_gauss(count, place.x))
    for (const double y : through_gauss(count, place.y)) values.push_back(x * y);
  return values;
}

LinkMesh::LinkMesh(const MeshLink& link, const LineAxis& axis) : depth(link.depth) {
  chord = axis.end - axis.start;
  length = norm(chord);
  for (const Vec2 place : link.mesh.nodes) nodes.push_back(place - axis.start);
  unknown.assign(nodes.size(), 0);
  for (const std::size_t n : link.base) unknown[n] = at_base;
  for (const std::size_t n : link.action) unknown[n] = at_action;
  for (std::size_t& first : unknown) {
    if (first != 0) continue;
    first = pose;
    pose += 2;
  }
  add_blocks(link.mesh);
  for (LinkBlock& block : blocks) map_elements(block, block.tables);
  make_pattern();
}

void LinkMesh::map_elements(const LinkBlock& block, ElementTables& tables) const {
  const std::size_t per = tables.nodes_per_element();
  for (std::size_t e = 0; e < block.elements(); ++e)
    tables.map_element([&](std::size_t a) { return nodes[block.nodes[e * per + a]]; },
                       [&](const ElementPoint&) { return depth; });
}

void LinkMesh::add_blocks(const PlaneMesh& mesh) {
  for (const ElementKind kind : {ElementKind::triangle3, ElementKind::triangle6, ElementKind::quad4,
                                 ElementKind::quad8, ElementKind::quad9}) {
    LinkBlock block{kind, make_tables(kind, quadrature_of(kind)), {}, elements, points};
    for (const PlaneMesh::Element& element : mesh.elements)
      for (std::size_t a = 0; element.kind == kind && a < nodes_of(kind); ++a)
        block.nodes.push_back(mesh.node(element, own_node(kind, a)));
    if (block.nodes.empty()) continue;
    elements += block.elements();
    points += block.elements() * block.tables.points.size();
    blocks.push_back(std::move(block));
  }
}

void LinkMesh::element_unknowns(const LinkBlock& block, std::size_t element,
                                std::vector<std::size_t>& unknowns) const {
  unknowns.clear();
  const std::size_t per = block.tables.nodes_per_element();
  bool moved = false;
  for (std::size_t a = 0; a < per; ++a) {
    const std::size_t first = unknown[block.nodes[element * per + a]];
    moved = moved || first == at_action;
    if (first >= at_action) continue;
    unknowns.push_back(first);
    unknowns.push_back(first + 1);
  }
  for (std::size_t i = 0; moved && i < 3; ++i) unknowns.push_back(pose + i);
}

Eigen::MatrixXd LinkMesh::slopes(const LinkBlock& block, std::size_t element, double turn) const {
  const std::size_t per = block.tables.nodes_per_element();
  const std::size_t* own = block.nodes.data() + element * per;
  const auto is_free = [&](std::size_t n) { return unknown[n] < at_action; };
  const auto moved = static_cast<Eigen::Index>(2 * std::count_if(own, own + per, is_free));
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(2 * per), moved + 3);
  Eigen::Index column = 0;
  for (std::size_t a = 0; a < per; ++a) {
    const auto row = static_cast<Eigen::Index>(2 * a);
    if (unknown[own[a]] == at_base) continue;
    const bool at_tip = unknown[own[a]] == at_action;
    const Eigen::Index first = at_tip ? moved : column;
    slopes(row, first) = slopes(row + 1, first + 1) = length;
    if (!at_tip) {
      column += 2;
      continue;
    }
    const Vec2 arm = rotate(turn, nodes[own[a]] - chord);
    slopes(row, moved + 2) = -arm.y;
    slopes(row + 1, moved + 2) = arm.x;
  }
  return slopes;
}

void LinkMesh::make_pattern() {
  using Entry = Eigen::Triplet<double>;
  std::vector<Entry> entries;
  std::vector<std::size_t> unknowns;
  const auto for_pairs = [&](const auto& use) {
    for (const LinkBlock& block : blocks)
      for (std::size_t e = 0; e < block.elements(); ++e) {
        element_unknowns(block, e, unknowns);
        first_place.push_back(places.size());
        for (std::size_t i = 0; i < unknowns.size(); ++i)
          for (std::size_t j = 0; j <= i; ++j) {
            const auto [low, high] = std::minmax(unknowns[i], unknowns[j]);
            use(static_cast<int>(high), static_cast<int>(low));
          }
      }
  };
  for_pairs([&](int row, int column) { entries.emplace_back(row, column, 0.0); });
  const auto n = static_cast<Eigen::Index>(size());
  for (int i = 0; i < static_cast<int>(size()); ++i) entries.emplace_back(i, i, 0.0);
  pattern.resize(n, n);
  pattern.setFromTriplets(entries.begin(), entries.end());
  pattern.makeCompressed();
  first_place.clear();
  for_pairs([&](int row, int column) {
    const int* begin = pattern.innerIndexPtr() + pattern.outerIndexPtr()[column];
    const int* end = pattern.innerIndexPtr() + pattern.outerIndexPtr()[column + 1];
    places.push_back(static_cast<int>(std::lower_bound(begin, end, row) - pattern.innerIndexPtr()));
  });
}

std::vector<LinkSide> border_sides(const LinkMesh& mesh) {
  std::map<std::pair<std::size_t, std::size_t>, LinkSide> sides;
  for (const LinkBlock& block : mesh.blocks) {
    const std::size_t per = block.tables.nodes_per_element();
    const std::size_t corners = corners_of(block.kind);
    constexpr std::size_t around[4] = {0, 2, 3, 1};  // of four-node elements, counter-clockwise
    for (std::size_t e = 0; e < block.elements(); ++e)
      for (std::size_t a = 0; a < corners; ++a) {
        const std::size_t* own = block.nodes.data() + e * per;
        const auto corner = [&](std::size_t k) {
          return own[block.kind == ElementKind::quad4 ? around[k % corners] : k % corners];
        };
        const LinkSide side{corner(a), per > corners ? own[corners + a] : LinkSide::none,
                            corner(a + 1)};
        if (sides.erase({side.to, side.from}) == 0) sides[{side.from, side.to}] = side;
      }
  }
  std::vector<LinkSide> border;
  border.reserve(sides.size());
  for (const auto& [ends, side] : sides) border.push_back(side);
  return border;
}

}  // namespace flexura

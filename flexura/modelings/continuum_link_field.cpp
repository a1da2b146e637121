#include "flexura/modelings/continuum_link_field.hpp"

#include <map>
#include <optional>
#include <utility>

#include "flexura/modelings/continuum_element.hpp"
#include "flexura/modelings/continuum_law.hpp"
#include "flexura/modelings/continuum_stress.hpp"

namespace flexura {
namespace {

/// Recovers a continuous stress after Zienkiewicz and Zhu (Int. J. Num. Meth. Eng. 24, 1987), as
/// that of strips, but in axes that rotate with the material. Sides that are fastened to no body
/// carry none across themselves.
class LinkRecovery {
 public:
  LinkRecovery(const LinkMesh& mesh, const Material& material, const ContinuumSettings& settings,
               const std::vector<Vec2>& places)
      : mesh_(mesh),
        material_(material),
        settings_(settings),
        raw_(mesh.points),
        turns_(mesh.nodes.size()),
        weights_(mesh.nodes.size(), 0.0) {
    field_.drawn = mesh.nodes;
    field_.places = places;
    field_.stresses.resize(mesh.nodes.size());
    field_.error_energies.resize(mesh.elements, 0.0);
  }

  template <class Density>
  StressField run(const Density& density, const double* strains) {
    for (const LinkBlock& block : mesh_.blocks) {
      add_pieces(block);
      add_block(block, density, strains);
    }
    average();
    free_sides();
    for (const LinkBlock& block : mesh_.blocks) measure(block);
    for (std::size_t n = 0; n < turns_.size(); ++n)
      field_.stresses[n] = turned(turns_[n].x, turns_[n].y, field_.stresses[n]);
    return std::move(field_);
  }

 private:
  template <class Density>
  void add_block(const LinkBlock& block, const Density& density, const double* strains);
  /// Of the polar decomposition, at a quadrature point.
  Vec2 turn_at(const LinkBlock& block, std::size_t element, std::size_t point) const;
  void average();
  void free_sides();
  void measure(const LinkBlock& block);
  void add_pieces(const LinkBlock& block);

  const LinkMesh& mesh_;
  const Material& material_;
  const ContinuumSettings& settings_;
  std::vector<PlaneStress> raw_;  // of every quadrature point, in axes that rotate with it
  std::vector<Vec2> turns_;       // of the nodes, as cosine and sine
  std::vector<double> weights_;
  StressField field_;
};

Vec2 LinkRecovery::turn_at(const LinkBlock& block, std::size_t element, std::size_t point) const {
  const ElementTables& tables = block.tables;
  const std::size_t per = tables.nodes_per_element();
  Vec2 by_xi, by_eta;
  for (std::size_t a = 0; a < per; ++a) {
    const Vec2 place = field_.places[block.nodes[element * per + a]];
    by_xi = by_xi + tables.by_xi[point * per + a] * place;
    by_eta = by_eta + tables.by_eta[point * per + a] * place;
  }
  const DeformationGradient f = deformation_gradient(
      by_xi, by_eta, tables.maps[element * tables.points.size() + point].inverse);
  const Vec2 turn{f.f11 + f.f22, f.f21 - f.f12};
  return (1.0 / norm(turn)) * turn;
}

template <class Density>
void LinkRecovery::add_block(const LinkBlock& block, const Density& density,
                             const double* strains) {
  const std::size_t per = block.tables.nodes_per_element();
  const std::size_t count = block.tables.points.size();
  std::vector<std::vector<double>> to_nodes;
  for (const Vec2 place : block_places(block.kind))
    to_nodes.push_back(through_points(block.kind, place));
  std::vector<Vec2> turns(count);
  for (std::size_t e = 0; e < block.elements(); ++e) {
    PlaneStress* raw = raw_.data() + block.first_point + e * count;
    double volume = 0.0;
    for (std::size_t g = 0; g < count; ++g) {
      raw[g] = rotated_stress(density, strains + 3 * (block.first_point + e * count + g));
      turns[g] = turn_at(block, e, g);
      volume += block.tables.maps[e * count + g].volume;
    }
    for (std::size_t a = 0; a < per; ++a) {
      const std::size_t node = block.nodes[e * per + a];
      for (std::size_t g = 0; g < count; ++g) {
        const double weight = volume * to_nodes[a][g];
        field_.stresses[node] = field_.stresses[node] + weight * raw[g];
        turns_[node] = turns_[node] + weight * turns[g];
      }
      weights_[node] += volume;
    }
  }
}

void LinkRecovery::average() {
  for (std::size_t n = 0; n < weights_.size(); ++n) {
    field_.stresses[n] = (1.0 / weights_[n]) * field_.stresses[n];
    turns_[n] = (1.0 / norm(turns_[n])) * turns_[n];
  }
}

/// Directions of a side at its start, its middle node if it has one, and its end.
struct SideDirections {
  explicit SideDirections(const LinkSide& side, const std::vector<Vec2>& places) {
    const Vec2 a = places[side.from], b = places[side.to];
    const Vec2 bulge =
        side.middle == LinkSide::none ? Vec2{} : 4.0 * (places[side.middle] - 0.5 * (a + b));
    start = b - a + bulge;
    middle = b - a;
    end = b - a - bulge;
  }
  Vec2 start, middle, end;
};

/// The border that is fastened to no body carries no stress across itself, where it has a
/// direction: not at its corners.
void LinkRecovery::free_sides() {
  constexpr double smooth = 1.88;  // of two unit vectors that 40 degrees lie between
  std::map<std::size_t, std::pair<Vec2, int>> tangents;
  const auto add = [&](std::size_t node, Vec2 direction) {
    auto& [sum, count] = tangents[node];
    sum = sum + (1.0 / norm(direction)) * direction;
    ++count;
  };
  for (const LinkSide& side : border_sides(mesh_)) {
    const SideDirections directions(side, field_.places);
    add(side.from, directions.start);
    add(side.to, directions.end);
    if (side.middle == LinkSide::none) continue;
    add(side.middle, directions.middle);
    add(side.middle, directions.middle);
  }
  for (const auto& [node, tangent] : tangents) {
    if (mesh_.unknown[node] >= LinkMesh::at_action) continue;
    if (tangent.second != 2 || norm(tangent.first) < smooth) continue;
    const Vec2 t = (1.0 / norm(tangent.first)) * tangent.first;
    const Vec2 turn = turns_[node];
    const Vec2 own{dot(turn, t), cross(turn, t)};  // seen by the material
    PlaneStress along = turned(own.x, -own.y, field_.stresses[node]);
    along.yy = along.xy = 0.0;
    field_.stresses[node] = turned(own.x, own.y, along);
  }
}

void LinkRecovery::measure(const LinkBlock& block) {
  const std::size_t per = block.tables.nodes_per_element();
  const std::size_t count = block.tables.points.size();
  for (std::size_t e = 0; e < block.elements(); ++e)
    for (std::size_t g = 0; g < count; ++g) {
      PlaneStress smooth;
      for (std::size_t a = 0; a < per; ++a)
        smooth =
            smooth + block.tables.values[g * per + a] * field_.stresses[block.nodes[e * per + a]];
      const double volume = block.tables.maps[e * count + g].volume;
      const PlaneStress off = smooth - raw_[block.first_point + e * count + g];
      field_.energy += volume * stress_energy(material_, settings_.plane, smooth);
      field_.error_energies[block.first_element + e] +=
          volume * stress_energy(material_, settings_.plane, off);
    }
}

/// Nodes of the parts that an element is drawn in, by its own numbers; a triangle has one less.
std::vector<std::vector<std::size_t>> parts_of(ElementKind kind) {
  switch (kind) {
    case ElementKind::triangle3:
      return {{0, 1, 2}};
    case ElementKind::triangle6:
      return {{0, 3, 5}, {1, 4, 3}, {2, 5, 4}, {3, 4, 5}};
    case ElementKind::quad4:
      return {{0, 2, 3, 1}};
    case ElementKind::quad8:
      return {{0, 4, 7}, {1, 5, 4}, {2, 6, 5}, {3, 7, 6}, {4, 5, 6, 7}};
    case ElementKind::quad9:
      return {{0, 4, 8, 7}, {4, 1, 5, 8}, {8, 5, 2, 6}, {7, 8, 6, 3}};
  }
  return {};
}

void LinkRecovery::add_pieces(const LinkBlock& block) {
  const std::size_t per = block.tables.nodes_per_element();
  const auto parts = parts_of(block.kind);
  for (std::size_t e = 0; e < block.elements(); ++e)
    for (const std::vector<std::size_t>& part : parts) {
      StressField::Piece piece{{}, part.size(), block.first_element + e};
      for (std::size_t i = 0; i < piece.nodes.size(); ++i)
        piece.nodes[i] = block.nodes[e * per + part[std::min(i, part.size() - 1)]];
      field_.pieces.push_back(piece);
    }
}

}  // namespace

StressField recover_link_stress(const LinkMesh& mesh, const Material& material,
                                const ContinuumSettings& settings, const std::vector<Vec2>& places,
                                const double* strains) {
  LinkRecovery recovery(mesh, material, settings, places);
  return with_density(material, settings,
                      [&](const auto& density) { return recovery.run(density, strains); });
}

}  // namespace flexura

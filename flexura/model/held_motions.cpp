#include "flexura/model/held_motions.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <unordered_map>

// What a joint holds of small motions of rigid bodies about the drawn configuration are rows of a
// matrix, the constraint Jacobian J, on rates (x, y, rotation) of the moving bodies: a place p of a
// body has the rate (x - rotation p_y, y + rotation p_x). A joint is redundant if a row of it
// depends on rows of drivers and of joints before it. Gram-Schmidt's method finds that, and keeps
// of what each of its vectors is made, which names those it depends on.
namespace flexura {
namespace {

/// Entries left out at the end are zero.
using Row = std::vector<double>;

double dot(const Row& a, const Row& b) {
  const auto length = static_cast<std::ptrdiff_t>(std::min(a.size(), b.size()));
  return std::inner_product(a.begin(), a.begin() + length, b.begin(), 0.0);
}

void add_multiple(Row& a, double factor, const Row& b) {
  if (a.size() < b.size()) a.resize(b.size(), 0.0);
  for (std::size_t i = 0; i < b.size(); ++i) a[i] += factor * b[i];
}

/// The rows met so far, as an orthonormal basis of what they span.
class HeldMotions {
 public:
  /// Takes a row on; if it depends on earlier ones, says on whose, and leaves it.
  std::set<Holder> add(Row row, const Holder& holder) {
    // Places typed with six digits still make parallel what is meant to be.
    constexpr double same_direction = 1e-6;
    constexpr double part_in_it = 1e-4;
    const double size = std::sqrt(dot(row, row));
    for (double& entry : row) entry /= size;
    Row parts(basis_.size() + 1, 0.0);
    parts.back() = 1.0;
    for (int pass = 0; pass < 2; ++pass) {  // twice is enough for orthogonality to rounding
      for (const Vector& vector : basis_) {
        const double share = -dot(row, vector.row);
        add_multiple(row, share, vector.row);
        add_multiple(parts, share, vector.parts);
      }
    }
    const double rest = std::sqrt(dot(row, row));
    if (rest > same_direction) {
      for (double& entry : row) entry /= rest;
      for (double& part : parts) part /= rest;
      basis_.push_back({std::move(row), std::move(parts), holder});
      return {};
    }
    std::set<Holder> others;
    for (std::size_t i = 0; i < basis_.size(); ++i)
      if (std::abs(parts[i]) > part_in_it) others.insert(basis_[i].holder);
    others.erase(holder);
    return others;
  }

  std::size_t size() const { return basis_.size(); }

 private:
  struct Vector {
    Row row;
    Row parts;  ///< of the rows as they came
    Holder holder;
  };
  std::vector<Vector> basis_;
};

bool moves(const Model& model, std::size_t body) {
  return body < model.bodies.size() && !model.bodies[body].fixed;
}

/// Joints that hold something, as far as their own mistakes let them.
bool is_sound(const Model& model, const Joint& joint) {
  if (joint.base >= model.bodies.size() || joint.action >= model.bodies.size()) return false;
  if (joint.base == joint.action) return false;
  if (!moves(model, joint.base) && !moves(model, joint.action)) return false;
  const auto* slide = std::get_if<PrismaticJoint>(&joint.kind);
  const Vec2 given = slide ? slide->direction : std::get<RevoluteJoint>(joint.kind).at;
  return std::isfinite(norm(given)) && (!slide || norm(given) > 0.0);
}

/// Moving bodies that joints hang together, with what acts on them.
struct Linkage {
  std::size_t bodies = 0;
  std::vector<Holder> holders;  ///< drivers, then joints, in the order of the file
  bool grounded = false;

  /// Without a loop, every joint holds something of its own.
  bool has_loop() const { return holders.size() + (grounded ? 0 : 1) > bodies; }
};

std::vector<Linkage> find_linkages(const Model& model) {
  std::vector<std::size_t> parent(model.bodies.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&parent](std::size_t body) {
    while (parent[body] != body) body = parent[body] = parent[parent[body]];
    return body;
  };
  for (const Joint& joint : model.joints)
    if (is_sound(model, joint) && moves(model, joint.base) && moves(model, joint.action))
      parent[root(joint.base)] = root(joint.action);
  std::vector<Linkage> linkages(model.bodies.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (moves(model, b)) ++linkages[root(b)].bodies;
  for (std::size_t d = 0; d < model.drivers.size(); ++d) {
    if (!moves(model, model.drivers[d].body)) continue;
    Linkage& linkage = linkages[root(model.drivers[d].body)];
    linkage.holders.push_back({Holder::Kind::driver, d});
    linkage.grounded = true;
  }
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const Joint& joint = model.joints[j];
    if (!is_sound(model, joint)) continue;
    Linkage& linkage = linkages[root(moves(model, joint.base) ? joint.base : joint.action)];
    linkage.holders.push_back({Holder::Kind::joint, j});
    linkage.grounded |= !moves(model, joint.base) || !moves(model, joint.action);
  }
  return linkages;
}

/// The rows of the Jacobian on the bodies of one linkage, which come in the order in which they are
/// met, so that early rows are short.
class Jacobian {
 public:
  Jacobian(const Model& model, const Linkage& linkage)
      : model_(model), size_(mechanism_size(model)) {
    if (!(size_ > 0.0)) size_ = 1.0;
    for (const Holder& holder : linkage.holders) {
      if (holder.kind == Holder::Kind::driver) {
        first_.try_emplace(model.drivers[holder.index].body, 3 * first_.size());
        continue;
      }
      const Joint& joint = model.joints[holder.index];
      for (const std::size_t body : {joint.base, joint.action})
        if (moves(model, body)) first_.try_emplace(body, 3 * first_.size());
      // Arms are short where the joints are, wherever that is.
      const auto* pin = std::get_if<RevoluteJoint>(&joint.kind);
      if (pin && !origin_) origin_ = pin->at;
    }
  }

  std::vector<Row> rows(const Holder& holder) const {
    if (holder.kind == Holder::Kind::driver) {
      const std::size_t body = model_.drivers[holder.index].body;
      return {row({{body, {1.0, 0.0}, 0.0}}), row({{body, {0.0, 1.0}, 0.0}}),
              row({{body, {}, 1.0}})};
    }
    const Joint& joint = model_.joints[holder.index];
    if (const auto* pin = std::get_if<RevoluteJoint>(&joint.kind)) {
      const Vec2 p = (1.0 / size_) * (pin->at - *origin_);
      return {row({{joint.action, {1.0, 0.0}, -p.y}, {joint.base, {-1.0, 0.0}, p.y}}),
              row({{joint.action, {0.0, 1.0}, p.x}, {joint.base, {0.0, -1.0}, -p.x}})};
    }
    const Vec2 direction = std::get<PrismaticJoint>(joint.kind).direction;
    const Vec2 n = (1.0 / norm(direction)) * perp(direction);
    return {row({{joint.action, n, 0.0}, {joint.base, -n, 0.0}}),
            row({{joint.action, {}, 1.0}, {joint.base, {}, -1.0}})};
  }

 private:
  struct Term {
    std::size_t body;
    Vec2 force;
    double moment;
  };

  /// Fixed bodies have no rates.
  Row row(std::initializer_list<Term> terms) const {
    Row row;
    for (const Term& term : terms) {
      const auto at = first_.find(term.body);
      if (at == first_.end()) continue;
      const std::size_t first = at->second;
      if (row.size() < first + 3) row.resize(first + 3, 0.0);
      row[first] += term.force.x;
      row[first + 1] += term.force.y;
      row[first + 2] += term.moment;
    }
    return row;
  }

  const Model& model_;
  std::unordered_map<std::size_t, std::size_t> first_;  ///< column of a body's x
  double size_;
  std::optional<Vec2> origin_;
};

void find_redundant_in(const Model& model, const Linkage& linkage,
                       std::vector<RedundantJoint>& found) {
  // The effort grows with the cube; no linkage drawn by hand comes near.
  constexpr std::size_t most_rows = 800;
  const Jacobian jacobian(model, linkage);
  HeldMotions held;
  for (const Holder& holder : linkage.holders) {
    if (held.size() > most_rows) return;
    std::set<Holder> others;
    for (Row& row : jacobian.rows(holder)) others.merge(held.add(std::move(row), holder));
    if (!others.empty() && holder.kind == Holder::Kind::joint)
      found.push_back({holder.index, {others.begin(), others.end()}});
  }
}

}  // namespace

std::vector<RedundantJoint> find_redundant_joints(const Model& model) {
  std::vector<RedundantJoint> found;
  for (const Linkage& linkage : find_linkages(model))
    if (linkage.has_loop()) find_redundant_in(model, linkage, found);
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return a.joint < b.joint; });
  return found;
}

}  // namespace flexura

#include "flexura/assembly/linkage_rates.hpp"

namespace flexura {

Eigen::VectorXd LinkageSystem::all_unknowns(const RigidState& state,
                                            const Eigen::VectorXd& q) const {
  if (dependent_.empty()) return q;
  return eliminate(state).b * q;
}

Eigen::VectorXd LinkageSystem::gather(std::size_t m, const Eigen::VectorXd& all) const {
  const LinkageLayout::Member& member = layout_.members[m];
  Eigen::VectorXd own = Eigen::VectorXd::Zero(member.link.size());
  for (std::size_t i = 0; i < member.unknowns.size(); ++i)
    if (member.unknowns[i] >= 0) own[static_cast<Eigen::Index>(i)] = all[member.unknowns[i]];
  return own;
}

Eigen::VectorXd LinkageSystem::member_unknowns(std::size_t m, const RigidState& state,
                                               const Eigen::VectorXd& q) const {
  const LinkageLayout::Member& member = layout_.members[m];
  Eigen::VectorXd u = gather(m, all_unknowns(state, q));
  turn_rows(u, member.link.pairs, unit(-state.parts[member.part].turn));
  return u;
}

/// With u = T U: T U'' + 2 T' U' + T'' U, and what axes that turn at w add to the displacements of
/// places, 2 w G u' + (w' G + w^2 G^2) u: of pairs the whole comes to T U''.
Eigen::VectorXd LinkageSystem::link_acceleration(std::size_t m, const RigidState& state,
                                                 const DriveRate& drive, double speed,
                                                 const ElasticState& elastic) const {
  const LinkageLayout::Member& member = layout_.members[m];
  Eigen::VectorXd second = elastic.second;
  if (!dependent_.empty()) {
    const Elimination e = eliminate(state);
    const double w = speed * drive.rate;
    second = e.b * elastic.second + 2.0 * w * e.first * elastic.first +
             (w * w * e.second + speed * speed * drive.rate * drive.slope * e.first) * elastic.q;
  }
  Eigen::VectorXd own = gather(m, second);
  turn_rows(own, member.link.pairs, unit(-state.parts[member.part].turn));
  return own;
}

std::vector<Eigen::Vector2d> LinkageSystem::element_loads(std::size_t m, const RigidState& state,
                                                          const DriveRate& drive, double speed,
                                                          const ElasticState& elastic) const {
  const LinkageLayout::Member& member = layout_.members[m];
  if (member.link.elements.empty()) return {};
  const PartMotion& part = state.parts[member.part];
  const PartRates rates = rates_of(part, drive);
  const Eigen::VectorXd second = link_acceleration(m, state, drive, speed, elastic);
  // What turns with the link and is no pair: rotations, by which arms move ends.
  const Eigen::VectorXd u = member_unknowns(m, state, elastic.q);
  const Eigen::VectorXd first = member_unknowns(m, state, elastic.first);
  const auto& pairs = member.link.pairs;
  const auto without_pairs = [&](Eigen::VectorXd v) {
    for (const Eigen::Index i : pairs) v[i] = v[i + 1] = 0.0;
    return v;
  };
  const double spin = speed * rates.spin, spin_rate = speed * speed * rates.spin_rate;
  const Eigen::VectorXd turned = without_pairs(u), turning = without_pairs(first);
  std::vector<Eigen::Vector2d> loads;
  for (const ElasticLink::Element& element : member.link.elements) {
    Eigen::Vector2d load;
    for (int end = 0; end < 2; ++end) {
      const PartMotion point = rigid_.point(state, member.part, element.ends[end]);
      const Vec2 rigid = (speed * speed) * acceleration_of(point, drive) - layout_.gravity;
      const Vec2 own = rotate(-part.turn, rigid);
      const Eigen::Vector2d moved = element.displacement[end] * second;
      const Eigen::Vector2d r = element.displacement[end] * turned;
      const Eigen::Vector2d v = element.displacement[end] * turning;
      const Vec2 carried = 2.0 * spin * perp({v[0], v[1]}) + spin_rate * perp({r[0], r[1]}) -
                           (spin * spin) * Vec2{r[0], r[1]};
      load[end] =
          -element.mass_per_length * dot(element.normal, own + Vec2{moved[0], moved[1]} + carried);
    }
    loads.push_back(load);
  }
  return loads;
}

Eigen::Vector3d LinkageSystem::body_displacement(const LinkageLayout::Place& place,
                                                 const RigidState& state,
                                                 const Eigen::VectorXd& q) const {
  const Eigen::VectorXd all = all_unknowns(state, q);
  Eigen::Vector3d u = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k)
    if (place.unknowns[k] >= 0) u[static_cast<Eigen::Index>(k)] = all[place.unknowns[k]];
  const Vec2 arm = perp(rotate(state.parts[place.part].turn, place.at - place.centre));
  return {u[0] + u[2] * arm.x, u[1] + u[2] * arm.y, u[2]};
}

}  // namespace flexura

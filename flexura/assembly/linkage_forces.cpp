#include "flexura/assembly/linkage_system.hpp"

namespace flexura {

/// m a of all mass, and what turns it about the part's centre.
std::vector<LinkageSystem::PartForce> LinkageSystem::inertia_forces(const RigidState& state,
                                                                    const DriveRate& drive,
                                                                    double speed) const {
  std::vector<PartForce> forces(state.parts.size());
  const double w2 = speed * speed;
  const auto acceleration = [&](std::size_t part, Vec2 at) {
    const PartMotion p = rigid_.point(state, part, at);
    return (w2 * drive.rate * drive.rate) * p.second + (w2 * drive.rate * drive.slope) * p.first;
  };
  const auto spin_rate = [&](std::size_t part) {
    const PartMotion& p = state.parts[part];
    return w2 * (drive.rate * drive.rate * p.second_turn + drive.rate * drive.slope * p.first_turn);
  };
  const auto add = [&](std::size_t part, Vec2 at, double mass, double inertia) {
    const Vec2 force = mass * acceleration(part, at);
    const Vec2 arm = rotate(state.parts[part].turn, at - layout_.rigid.parts[part].centre);
    forces[part].force = forces[part].force + force;
    forces[part].moment += cross(arm, force) + inertia * spin_rate(part);
  };
  for (const LinkageLayout::Member& member : layout_.members) {
    for (std::size_t g = 0; g < member.link.places.size(); ++g)
      add(member.part, member.link.places[g], member.link.masses[g], 0.0);
    for (const ElasticLink::Slice& slice : member.link.slices)
      forces[member.part].moment += slice.rotary_inertia * spin_rate(member.part);
  }
  for (const LinkageLayout::Mass& mass : layout_.masses)
    add(mass.centre.part, mass.centre.centre, mass.mass, mass.inertia);
  return forces;
}

std::vector<LinkageSystem::PartForce> LinkageSystem::load_forces(const RigidState& state) const {
  std::vector<PartForce> forces(state.parts.size());
  const auto add = [&](std::size_t part, Vec2 at, Vec2 force, double moment) {
    const Vec2 arm = rotate(state.parts[part].turn, at - layout_.rigid.parts[part].centre);
    forces[part].force = forces[part].force + force;
    forces[part].moment += cross(arm, force) + moment;
  };
  for (const LinkageLayout::Load& load : layout_.loads) {
    const double factor = load_factor(load, state.angle);
    const double turn = state.parts[load.place.part].turn;
    add(load.place.part, load.place.at,
        factor * (load.follower ? rotate(turn, load.force) : load.force), factor * load.moment);
  }
  for (const LinkageLayout::Member& member : layout_.members)
    for (std::size_t g = 0; g < member.link.places.size(); ++g)
      add(member.part, member.link.places[g], member.link.masses[g] * layout_.gravity, 0.0);
  for (const LinkageLayout::Mass& mass : layout_.masses)
    add(mass.centre.part, mass.centre.centre, mass.mass * layout_.gravity, 0.0);
  return forces;
}

}  // namespace flexura

#include "flexura/studies/linkage_record.hpp"

#include <algorithm>
#include <cmath>

#include "flexura/core/plane_stress.hpp"
#include "flexura/modelings/make_linkage.hpp"

namespace flexura {
namespace {

/// Value of a reading of a member, with what the inertia inside its elements adds.
double value_of(const ElasticLink::Reading& reading, const Eigen::VectorXd& u,
                const std::vector<Eigen::Vector2d>& loads) {
  double value = reading.by_u.dot(u);
  if (loads.empty()) return value;
  for (const ElasticLink::InertiaPart& part : reading.inertia)
    value += part.by_load.dot(loads[part.element]);
  return value;
}

std::vector<Eigen::Vector2d> loads_of(const LinkageStudy& study, const LinkageTurn& turn,
                                      std::size_t member, double angle, double speed,
                                      const ElasticState& state) {
  if (!study.inertia_correction) return {};
  return turn.system().element_loads(member, turn.state(angle), turn.drive(angle), speed, state);
}

Vec2 moved(const LinkageSystem& system, const RigidState& state, std::size_t part, Vec2 drawn) {
  return system.rigid().point(state, part, drawn).displacement;
}

/// A force and a moment for every unknown of the rigid linkage, lengths over its size.
Eigen::VectorXd by_columns(const RigidLinkage& rigid,
                           const std::vector<LinkageSystem::PartForce>& forces, Eigen::Index n) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(n);
  const RigidLinkageLayout& layout = rigid.layout();
  for (std::size_t p = 0; p < forces.size(); ++p) {
    const int first = rigid.first_column(p);
    if (p == layout.driven) sum[n - 1] += forces[p].moment;
    if (first < 0) continue;
    sum[first] += layout.size * forces[p].force.x;
    sum[first + 1] += layout.size * forces[p].force.y;
    if (layout.parts[p].turns) sum[first + 2] += forces[p].moment;
  }
  return sum;
}

/// Inverse dynamics: what the joints carry and the drive turns with, for rigid links.
void record_forces(const LinkageTurn& turn, double angle, double speed, RigidPosition& position) {
  const LinkageSystem& system = turn.system();
  const RigidLinkage& rigid = system.rigid();
  const RigidState& state = turn.state(angle);
  const Eigen::MatrixXd jacobian = rigid.jacobian(state);
  const Eigen::Index n = jacobian.cols();
  const auto inertia = system.inertia_forces(state, turn.drive(angle), speed);
  const Eigen::VectorXd needed =
      by_columns(rigid, inertia, n) - by_columns(rigid, system.load_forces(state), n);
  const Eigen::MatrixXd transposed = jacobian.leftCols(n - 1).transpose();
  Eigen::VectorXd carried = Eigen::VectorXd::Zero(jacobian.rows());
  if (n > 1) carried = transposed.completeOrthogonalDecomposition().solve(needed.head(n - 1));
  position.torque = needed[n - 1] - jacobian.col(n - 1).dot(carried);
  const double size = rigid.layout().size;
  for (std::size_t k = 0; k < rigid.layout().pins.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(2 * k);
    position.reactions.push_back({-carried[row] / size, -carried[row + 1] / size});
  }
  const Vec2 origin = rigid.layout().parts[rigid.layout().driven].centre;
  for (std::size_t p = 1; p < inertia.size(); ++p) {
    const Vec2 centre = moved(system, state, p, rigid.layout().parts[p].centre);
    position.shaking_force = position.shaking_force - inertia[p].force;
    position.shaking_moment -= inertia[p].moment + cross(centre - origin, inertia[p].force);
  }
}

}  // namespace

LinkageResult make_linkage_names(const Model& model, const LinkageStudy& study,
                                 const LinkageTurn& turn) {
  LinkageResult result;
  for (const Body& body : model.bodies) {
    if (body.fixed) continue;
    result.bodies.push_back(body.name);
    for (const Point& point : body.points) result.points.push_back(body.name + "." + point.name);
  }
  for (std::size_t k = 0; k < model.flexures.size(); ++k) {
    const Flexure& flexure = model.flexures[k];
    result.flexures.push_back(flexure.name);
    result.strengths.push_back(model.materials[flexure.material].strength);
    std::vector<double> stations;
    for (const auto& station : turn.system().layout().members[k].link.stations)
      stations.push_back(station.s);
    result.stations.push_back(std::move(stations));
    for (const bool base : {true, false})
      if (base ? flexure.pinned_base : flexure.pinned_action)
        result.pins.push_back(flexure.name + " on " +
                              model.bodies[base ? flexure.base : flexure.action].name);
  }
  for (const Joint& joint : model.joints)
    if (std::holds_alternative<RevoluteJoint>(joint.kind)) result.pins.push_back(joint.name);
  const Driver& driver = model.drivers[study.driver];
  result.driver = driver.name;
  result.speed = std::abs(driver.amount);
  return result;
}

void record_rigid_motion(const Model& model, const LinkageStudy& study, const LinkageTurn& turn,
                         LinkageResult& result) {
  const LinkageSystem& system = turn.system();
  const RigidParts parts = rigid_parts(model, study.driver);
  for (const double angle : turn.positions()) {
    const RigidState& state = turn.state(angle);
    RigidPosition position;
    position.angle = turn.sense() * angle;
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      if (model.bodies[b].fixed) continue;
      const std::size_t part = parts.of_bodies[b];
      position.bodies.push_back(
          {moved(system, state, part, body_centre(model, b)), state.parts[part].turn});
      for (const Point& point : model.bodies[b].points)
        position.points.push_back(moved(system, state, part, point.position));
    }
    for (const LinkageLayout::Member& member : system.layout().members) {
      std::vector<Vec2> axis;
      for (const auto& station : member.link.stations)
        axis.push_back(moved(system, state, member.part, station.place));
      position.flexures.push_back(std::move(axis));
    }
    record_forces(turn, angle, result.speed, position);
    result.positions.push_back(std::move(position));
  }
}

Eigen::RowVectorXd strains_at(const LinkageStudy& study, const LinkageTurn& turn, double angle,
                              double speed, const ElasticState& state) {
  const LinkageSystem& system = turn.system();
  const auto& members = system.layout().members;
  Eigen::RowVectorXd strains(static_cast<Eigen::Index>(members.size()));
  for (std::size_t m = 0; m < members.size(); ++m)
    strains[static_cast<Eigen::Index>(m)] =
        value_of(members[m].link.strain, system.member_unknowns(m, turn.state(angle), state.q),
                 loads_of(study, turn, m, angle, speed, state));
  return strains;
}

Eigen::MatrixXd middle_strains(const LinkageStudy& study, const LinkageTurn& turn, double speed,
                               const std::vector<ElasticState>& states) {
  const std::vector<double> angles = turn.positions();
  Eigen::MatrixXd strains(static_cast<Eigen::Index>(states.size()),
                          static_cast<Eigen::Index>(turn.system().layout().members.size()));
  for (std::size_t i = 0; i < states.size(); ++i)
    strains.row(static_cast<Eigen::Index>(i)) =
        strains_at(study, turn, angles[i], speed, states[i]);
  return strains;
}

double strain_distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  if (b.size() == 0) return 0.0;
  double worst = 0.0;
  const double largest = b.cwiseAbs().maxCoeff();
  for (Eigen::Index m = 0; m < a.cols(); ++m) {
    const double size = std::max(b.col(m).cwiseAbs().maxCoeff(), 1e-6 * largest);
    if (size > 0.0) worst = std::max(worst, (a.col(m) - b.col(m)).cwiseAbs().maxCoeff() / size);
  }
  return worst;
}

namespace {

/// Of a link of any shape: the largest and the smallest principal stress near every station; the
/// largest absolute one of all.
double record_plate(const ElasticLink::Field& field, const Eigen::VectorXd& u,
                    std::vector<double>& upper, std::vector<double>& lower) {
  const Eigen::VectorXd stress = field.stress * u;
  std::vector<bool> known(upper.size(), false);
  double largest = 0.0;
  for (std::size_t n = 0; n < field.station.size(); ++n) {
    const auto row = static_cast<Eigen::Index>(3 * n);
    const PrincipalStress principal =
        principal_stress({stress[row], stress[row + 1], stress[row + 2], 0.0});
    const std::size_t at = field.station[n];
    upper[at] = known[at] ? std::max(upper[at], principal.first) : principal.first;
    lower[at] = known[at] ? std::min(lower[at], principal.second) : principal.second;
    known[at] = true;
    largest = std::max({largest, std::abs(principal.first), std::abs(principal.second)});
  }
  return largest;
}

/// One flexure at one position.
void record_flexure(const LinkageLayout::Member& member, const RigidState& rigid,
                    const Eigen::VectorXd& u, const std::vector<Eigen::Vector2d>& loads,
                    FlexureCurves& curves, std::vector<Vec2>& displacements) {
  const ElasticLink& link = member.link;
  curves.strain.push_back(value_of(link.strain, u, loads));
  curves.axial_strain.push_back(value_of(link.axial_strain, u, loads));
  curves.deflection.push_back(value_of(link.deflection, u, loads));
  std::vector<double> upper, lower;
  double largest = 0.0;
  for (const ElasticLink::Station& station : link.stations) {
    const double bending = value_of(station.bending_stress, u, loads);
    const double axial = value_of(station.axial_stress, u, loads);
    upper.push_back(axial + bending);
    lower.push_back(axial - bending);
    largest = std::max(largest, std::abs(axial) + std::abs(bending));
    const Eigen::Vector2d moved = station.displacement * u;
    displacements.push_back(rotate(rigid.parts[member.part].turn, {moved[0], moved[1]}));
  }
  if (link.field.stress.size() > 0) largest = record_plate(link.field, u, upper, lower);
  curves.stress.push_back(largest);
  curves.upper_stress.push_back(std::move(upper));
  curves.lower_stress.push_back(std::move(lower));
}

}  // namespace

void record_elastic_motion(const Model& model, const LinkageStudy& study, const LinkageTurn& turn,
                           const std::vector<ElasticState>& states, LinkageMotion& motion) {
  const LinkageSystem& system = turn.system();
  const std::vector<double> angles = turn.positions();
  const double speed = std::abs(model.drivers[study.driver].amount);
  const RigidParts parts = rigid_parts(model, study.driver);
  const std::vector<LinkageLayout::Place> places = body_places(model, parts);
  motion.flexures.resize(model.flexures.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    const RigidState& rigid = turn.state(angles[i]);
    std::vector<std::vector<Vec2>> displacements(model.flexures.size());
    for (std::size_t m = 0; m < model.flexures.size(); ++m)
      record_flexure(system.layout().members[m], rigid,
                     system.member_unknowns(m, rigid, states[i].q),
                     loads_of(study, turn, m, angles[i], speed, states[i]), motion.flexures[m],
                     displacements[m]);
    motion.displacements.push_back(std::move(displacements));
    std::vector<Vec2> bodies, points;
    const auto displacement = [&](LinkageLayout::Place place, Vec2 at) {
      place.at = at;
      const Eigen::Vector3d d = system.body_displacement(place, rigid, states[i].q);
      return Vec2{d[0], d[1]};
    };
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      if (model.bodies[b].fixed) continue;
      bodies.push_back(displacement(places[b], body_centre(model, b)));
      for (const Point& point : model.bodies[b].points)
        points.push_back(displacement(places[b], point.position));
    }
    motion.bodies.push_back(std::move(bodies));
    motion.points.push_back(std::move(points));
  }
}

}  // namespace flexura

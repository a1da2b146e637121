#include "flexura/assembly/linkage_system.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include "flexura/assembly/linkage_rates.hpp"
#include "flexura/core/jet2.hpp"

namespace flexura {
namespace {

using Angle = Jet2<1>;  // a function of the angle of the drive

/// A T and T^T A, T the turn of pairs of unknowns from fixed axes into those of a link.
void turn_columns(Eigen::MatrixXd& a, const std::vector<Eigen::Index>& pairs, Vec2 e) {
  for (const Eigen::Index i : pairs) {
    const Eigen::VectorXd x = a.col(i);
    a.col(i) = e.x * x - e.y * a.col(i + 1);
    a.col(i + 1) = e.y * x + e.x * a.col(i + 1);
  }
}
Eigen::MatrixXd turned(Eigen::MatrixXd a, const std::vector<Eigen::Index>& pairs, Vec2 e) {
  turn_columns(a, pairs, e);
  turn_rows(a, pairs, e);
  return a;
}

/// A G, G the turn of pairs by +90 degrees.
Eigen::MatrixXd times_turn(const Eigen::MatrixXd& a, const std::vector<Eigen::Index>& pairs) {
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(a.rows(), a.cols());
  for (const Eigen::Index i : pairs) {
    product.col(i) = a.col(i + 1);
    product.col(i + 1) = -a.col(i);
  }
  return product;
}

void scatter(const Eigen::MatrixXd& a, const std::vector<int>& unknowns, Eigen::MatrixXd& sum) {
  for (Eigen::Index j = 0; j < a.cols(); ++j)
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      const int row = unknowns[static_cast<std::size_t>(i)];
      const int column = unknowns[static_cast<std::size_t>(j)];
      if (row >= 0 && column >= 0) sum(row, column) += a(i, j);
    }
}

}  // namespace

double LinkageSystem::load_factor(const LinkageLayout::Load& load, double angle) {
  constexpr double turn = 2.0 * std::numbers::pi;
  // the end of a turn is its end, not the beginning of the next
  const double turns = std::ceil(angle / turn - 1e-12) - 1.0;
  return evaluate_history(load.history, angle - std::max(0.0, turns) * turn).value;
}

LinkageSystem::LinkageSystem(LinkageLayout layout)
    : layout_(std::move(layout)), rigid_(layout_.rigid) {
  for (const LinkageLayout::Member& member : layout_.members) {
    const Vec2 centre = layout_.rigid.parts[member.part].centre;
    const auto& pairs = member.link.pairs;
    inertia_.push_back(link_inertia(member.link, centre));
    const LinkInertia& inertia = inertia_.back();
    turning_.push_back(inertia.mass_turned - times_turn(inertia.mass, pairs));
    carrying_.push_back(-times_turn(times_turn(inertia.mass, pairs), pairs) +
                        2.0 * times_turn(inertia.mass_turned, pairs) + inertia.mass_places);
    straining_.push_back(-times_turn(member.link.stiffness, pairs));
  }
  independent_.resize(static_cast<std::size_t>(layout_.unknowns));
  std::iota(independent_.begin(), independent_.end(), 0);
  if (layout_.pins.empty() && layout_.slides.empty()) return;
  RigidState drawn;
  drawn.parts.resize(layout_.rigid.parts.size());
  Eigen::MatrixXd rows = constraints(drawn).value;
  // Displacements follow rotations where they can: damping is by the rates of what remains, and
  // rotations are what elastic links have in common with their axes.
  const auto make_light = [&](const LinkageLayout::Place& place) {
    if (place.unknowns[2] >= 0) rows.col(place.unknowns[2]) *= 1e-6 / layout_.rigid.size;
  };
  for (const LinkageLayout::Pin& pin : layout_.pins)
    for (const auto* place : {&pin.first, &pin.second}) make_light(*place);
  for (const LinkageLayout::Slide& slide : layout_.slides)
    for (const auto* place : {&slide.base, &slide.action}) make_light(*place);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows);
  const auto& order = qr.colsPermutation().indices();
  std::vector<bool> depends(independent_.size());
  for (Eigen::Index k = 0; k < rows.rows(); ++k) depends[static_cast<std::size_t>(order[k])] = true;
  independent_.clear();
  for (std::size_t i = 0; i < depends.size(); ++i)
    (depends[i] ? dependent_ : independent_).push_back(static_cast<int>(i));
}

LinkageSystem::Rows LinkageSystem::constraints(const RigidState& state) const {
  const auto n = static_cast<Eigen::Index>(layout_.unknowns);
  const auto count = static_cast<Eigen::Index>(2 * (layout_.pins.size() + layout_.slides.size()));
  Rows rows{Eigen::MatrixXd::Zero(count, n), Eigen::MatrixXd::Zero(count, n),
            Eigen::MatrixXd::Zero(count, n)};
  const auto jet = [](double value, double first, double second) {
    Angle a(value);
    a.gradient[0] = first;
    a.hessian[0] = second;
    return a;
  };
  Eigen::Index row = 0;
  const auto add = [&](int unknown, const Angle& entry) {
    if (unknown < 0) return;
    rows.value(row, unknown) += entry.value;
    rows.first(row, unknown) += entry.gradient[0];
    rows.second(row, unknown) += entry.hessian[0];
  };
  struct Direction {
    Angle x, y;
  };
  const auto turn_of = [&](std::size_t part) {
    const PartMotion& p = state.parts[part];
    const Angle turn = jet(p.turn, p.first_turn, p.second_turn);
    return Direction{cos(turn), sin(turn)};
  };
  const auto rotated = [](const Direction& e, Vec2 a) {
    return Direction{a.x * e.x - a.y * e.y, a.x * e.y + a.y * e.x};
  };
  const auto add_place = [&](const LinkageLayout::Place& place, double sign,
                             const Direction& along) {
    const Direction r = rotated(turn_of(place.part), place.at - place.centre);
    add(place.unknowns[0], sign * along.x);
    add(place.unknowns[1], sign * along.y);
    add(place.unknowns[2], sign * (r.x * along.y - r.y * along.x));
  };
  for (const LinkageLayout::Pin& pin : layout_.pins)
    for (const Vec2 along : {Vec2{1, 0}, Vec2{0, 1}}) {
      const Direction fixed{Angle(along.x), Angle(along.y)};
      add_place(pin.first, 1.0, fixed);
      add_place(pin.second, -1.0, fixed);
      ++row;
    }
  for (const LinkageLayout::Slide& slide : layout_.slides) {
    const Direction along = rotated(turn_of(slide.base.part), slide.direction);
    const Direction normal{-along.y, along.x};
    const PartMotion action = rigid_.point(state, slide.action.part, slide.action.at);
    const PartMotion base = rigid_.point(state, slide.base.part, slide.base.at);
    const auto apart = [&](double Vec2::*axis) {
      return jet(action.displacement.*axis - base.displacement.*axis,
                 action.first.*axis - base.first.*axis, action.second.*axis - base.second.*axis);
    };
    add_place(slide.action, 1.0, normal);
    add_place(slide.base, -1.0, normal);
    // the normal turns with the base
    add(slide.base.unknowns[2], -(apart(&Vec2::x) * along.x + apart(&Vec2::y) * along.y));
    ++row;
    add(slide.action.unknowns[2], Angle(1.0));
    add(slide.base.unknowns[2], Angle(-1.0));
    ++row;
  }
  return rows;
}

/// G U = 0: U_d = D U_i with D = -G_d^-1 G_i, differentiated twice by the angle.
LinkageSystem::Elimination LinkageSystem::eliminate(const RigidState& state) const {
  Elimination e;
  if (dependent_.empty()) return e;
  const Rows g = constraints(state);
  const Eigen::PartialPivLU<Eigen::MatrixXd> held(g.value(Eigen::all, dependent_));
  const Eigen::MatrixXd d = -held.solve(g.value(Eigen::all, independent_));
  const Eigen::MatrixXd d1 =
      -held.solve(g.first(Eigen::all, independent_) + g.first(Eigen::all, dependent_) * d);
  const Eigen::MatrixXd d2 =
      -held.solve(g.second(Eigen::all, independent_) + g.second(Eigen::all, dependent_) * d +
                  2.0 * g.first(Eigen::all, dependent_) * d1);
  const auto n = static_cast<Eigen::Index>(layout_.unknowns);
  for (auto* b : {&e.b, &e.first, &e.second}) *b = Eigen::MatrixXd::Zero(n, size());
  for (Eigen::Index k = 0; k < size(); ++k) e.b(independent_[static_cast<std::size_t>(k)], k) = 1.0;
  e.b(dependent_, Eigen::all) = d;
  e.first(dependent_, Eigen::all) = d1;
  e.second(dependent_, Eigen::all) = d2;
  return e;
}

void LinkageSystem::add_member(std::size_t m, const RigidState& state, const DriveRate& drive,
                               bool coupling, LinkageMatrices& sum) const {
  const LinkageLayout::Member& member = layout_.members[m];
  const PartMotion& part = state.parts[member.part];
  const PartRates rates = rates_of(part, drive);
  const LinkInertia& inertia = inertia_[m];
  const auto& pairs = member.link.pairs;
  const Vec2 e = unit(part.turn);
  scatter(turned(inertia.mass, pairs, e), member.unknowns, sum.mass);
  scatter(turned(member.link.stiffness, pairs, e), member.unknowns, sum.stiffness);
  if (coupling) {
    const Eigen::MatrixXd turning = turned(turning_[m], pairs, e);
    scatter(2.0 * rates.spin * turning, member.unknowns, sum.turning);
    scatter(rates.spin_rate * turning - rates.spin * rates.spin * turned(carrying_[m], pairs, e),
            member.unknowns, sum.carrying);
    scatter(rates.spin * turned(straining_[m], pairs, e), member.unknowns, sum.straining);
  }
  const auto in_link = [&](Vec2 a) { return rotate(-part.turn, a); };
  const Vec2 origin = in_link(acceleration_of(part, drive));
  const Vec2 gravity = in_link(layout_.gravity);
  Eigen::MatrixXd loads(member.link.size(), 2);
  loads.col(0) = -(inertia.push * Eigen::Vector2d{origin.x, origin.y} +
                   rates.spin_rate * (inertia.twist + inertia.rotary) -
                   rates.spin * rates.spin * inertia.pull);
  loads.col(1) = inertia.push * Eigen::Vector2d{gravity.x, gravity.y};
  turn_rows(loads, pairs, e);
  for (std::size_t i = 0; i < member.unknowns.size(); ++i) {
    if (member.unknowns[i] < 0) continue;
    sum.inertia_load[member.unknowns[i]] += loads(static_cast<Eigen::Index>(i), 0);
    sum.load[member.unknowns[i]] += loads(static_cast<Eigen::Index>(i), 1);
  }
}

void LinkageSystem::add_mass(const LinkageLayout::Mass& mass, const RigidState& state,
                             const DriveRate& drive, LinkageMatrices& sum) const {
  const auto& unknowns = mass.centre.unknowns;
  const PartMotion centre = rigid_.point(state, mass.centre.part, mass.centre.centre);
  const Vec2 acceleration = acceleration_of(centre, drive);
  const double values[3] = {acceleration.x, acceleration.y,
                            rates_of(state.parts[mass.centre.part], drive).spin_rate};
  const double weight[3] = {layout_.gravity.x, layout_.gravity.y, 0.0};
  for (std::size_t k = 0; k < 3; ++k) {
    if (unknowns[k] < 0) continue;
    const double inertia = k < 2 ? mass.mass : mass.inertia;
    sum.mass(unknowns[k], unknowns[k]) += inertia;
    sum.inertia_load[unknowns[k]] -= inertia * values[k];
    sum.load[unknowns[k]] += inertia * weight[k];
  }
}

void LinkageSystem::add_load(const LinkageLayout::Load& load, const RigidState& state,
                             LinkageMatrices& sum) const {
  const double factor = load_factor(load, state.angle);
  const double turn = state.parts[load.place.part].turn;
  const Vec2 force = factor * (load.follower ? rotate(turn, load.force) : load.force);
  const Vec2 arm = rotate(turn, load.place.at - load.place.centre);
  const double values[3] = {force.x, force.y, factor * load.moment + cross(arm, force)};
  for (std::size_t k = 0; k < 3; ++k)
    if (load.place.unknowns[k] >= 0) sum.load[load.place.unknowns[k]] += values[k];
}

LinkageMatrices LinkageSystem::matrices(const RigidState& state, const DriveRate& drive,
                                        bool coupling) const {
  const auto n = static_cast<Eigen::Index>(layout_.unknowns);
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(n, n);
  LinkageMatrices sum{
      zero, zero, zero, zero, zero, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  for (std::size_t m = 0; m < layout_.members.size(); ++m)
    add_member(m, state, drive, coupling, sum);
  for (const LinkageLayout::Mass& mass : layout_.masses) add_mass(mass, state, drive, sum);
  for (const LinkageLayout::Load& load : layout_.loads) add_load(load, state, sum);
  if (dependent_.empty()) return sum;
  const Elimination e = eliminate(state);
  const double g = drive.rate;
  LinkageMatrices q;
  q.mass = e.b.transpose() * sum.mass * e.b;
  q.stiffness = e.b.transpose() * sum.stiffness * e.b;
  q.turning = e.b.transpose() * sum.turning * e.b;
  q.carrying = e.b.transpose() * sum.carrying * e.b;
  if (coupling) {
    q.turning += e.b.transpose() * (2.0 * g * sum.mass * e.first);
    q.carrying += e.b.transpose() * (g * sum.turning * e.first +
                                     sum.mass * (g * g * e.second + g * drive.slope * e.first));
  }
  q.straining = e.b.transpose() * sum.straining * e.b;
  if (coupling) q.straining += e.b.transpose() * (g * sum.stiffness * e.first);
  q.inertia_load = e.b.transpose() * sum.inertia_load;
  q.load = e.b.transpose() * sum.load;
  return q;
}

bool LinkageSystem::stiffens() const {
  for (const LinkageLayout::Member& member : layout_.members)
    for (const ElasticLink::Slice& slice : member.link.slices)
      if (slice.length > 0.0) return true;
  return false;
}

Eigen::MatrixXd LinkageSystem::stress_stiffness(const RigidState& state,
                                                const Eigen::VectorXd& q) const {
  const auto n = static_cast<Eigen::Index>(layout_.unknowns);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t m = 0; m < layout_.members.size(); ++m) {
    const LinkageLayout::Member& member = layout_.members[m];
    const Eigen::VectorXd u = member_unknowns(m, state, q);
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(u.size(), u.size());
    for (const ElasticLink::Slice& slice : member.link.slices)
      if (slice.length > 0.0)
        own += (slice.length * slice.normal_force.dot(u)) * slice.rotation.transpose() *
               slice.rotation;
    scatter(turned(std::move(own), member.link.pairs, unit(state.parts[member.part].turn)),
            member.unknowns, sum);
  }
  if (dependent_.empty()) return sum;
  const Elimination e = eliminate(state);
  return e.b.transpose() * sum * e.b;
}

}  // namespace flexura

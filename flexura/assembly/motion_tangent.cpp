#include <cmath>

#include "flexura/assembly/motion_system.hpp"
#include "flexura/assembly/spring_potential.hpp"

namespace flexura {

void MotionSystem::linearize(const Moment& moment) {
  stiffness_.setZero();
  damping_.setZero();
  mass_.setZero();
  for (std::size_t k = 0; k < members_.size(); ++k) {
    members_[k].linearize(member_load(k, moment.multipliers), internal(k, moment.q),
                          layout_.stiffness_damping != 0.0);
    const Placed& placed = placed_[k];
    const auto& unknowns = numbering_.members[k].unknowns;
    const Eigen::Index load = moving_ + load_row(k);
    for (int i = 0; i < port_unknowns; ++i) {
      if (unknowns[i] < 0) continue;
      // added: both ends of a flexure may share an unknown
      stiffness_.block<3, 1>(load, unknowns[i]) += placed.relative.jacobian.col(i);
      stiffness_.block<1, 3>(unknowns[i], load) += placed.relative.jacobian.col(i).transpose();
      if (linearised()) continue;
      for (int j = 0; j < port_unknowns; ++j)
        if (unknowns[j] >= 0) stiffness_(unknowns[i], unknowns[j]) += placed.relative.hessian(i, j);
    }
    const int turn = unknowns[base_turn];
    if (turn >= 0 && !linearised()) stiffness_(turn, turn) -= dot(placed.arm, placed.force);
  }
  for (std::size_t b = 0; b < numbering_.bodies.size(); ++b) {
    const Numbering::Body& index = numbering_.bodies[b];
    const auto& rigid = layout_.mechanism.bodies[b];
    if (index.position >= 0) mass_.segment<2>(index.position).array() += rigid.mass;
    if (index.rotation >= 0) mass_[index.rotation] += rigid.inertia;
  }
  linearize_pairs(moment);
  linearize_rest(moment);
}

/// Springs, dampers and joints: what depends on the six unknowns of two bodies.
void MotionSystem::linearize_pairs(const Moment& moment) {
  const SystemLayout& mechanism = layout_.mechanism;
  for (const auto& spring : mechanism.springs) {
    const Pose a = pose(spring.base, moment.q);
    const Pose b = pose(spring.action, moment.q);
    const Jet2<6> energy = spring_potential(mechanism, spring, a, b, 1.0);
    const auto unknowns = pair_unknowns(spring.base, spring.action);
    const double damping = layout_.damping_along(spring);
    const Jet2<6> length = damping > 0.0 ? spring_length(mechanism, spring, a, b) : Jet2<6>{};
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) {
        if (unknowns[i] < 0 || unknowns[j] < 0) continue;
        stiffness_(unknowns[i], unknowns[j]) += energy.second(i, j);
        damping_(unknowns[i], unknowns[j]) += damping * length.gradient[i] * length.gradient[j];
      }
  }
  for (std::size_t k = 0; k < mechanism.joints.size(); ++k) {
    const auto gaps = gaps_of(k, moment.q);
    const auto unknowns = pair_unknowns(mechanism.joints[k].base, mechanism.joints[k].action);
    for (std::size_t c = 0; c < 2; ++c) {
      const Eigen::Index row = joint_row(k) + static_cast<Eigen::Index>(c);
      const double force = moment.multipliers[row];
      for (std::size_t i = 0; i < 6; ++i) {
        if (unknowns[i] < 0) continue;
        stiffness_(moving_ + row, unknowns[i]) -= gaps[c].gradient[i];
        stiffness_(unknowns[i], moving_ + row) -= gaps[c].gradient[i];
        for (std::size_t j = 0; j < 6; ++j)
          if (unknowns[j] >= 0)
            stiffness_(unknowns[i], unknowns[j]) -= force * gaps[c].second(i, j);
      }
    }
  }
}

/// Loads that turn, or whose arms do, and what is prescribed.
void MotionSystem::linearize_rest(const Moment& moment) {
  const auto& loads = layout_.mechanism.loads;
  for (std::size_t i = 0; i < loads.size() && !linearised(); ++i) {
    const auto& load = loads[i];
    const Numbering::Body& index = numbering_.bodies[load.body];
    if (index.position < 0 || index.rotation < 0) continue;
    const double factor = evaluate_history(layout_.loads[i], moment.time).value;
    const double turn = pose(load.body, moment.q).rotation;
    if (load.follower) {
      const Vec2 change = factor * perp(rotate(turn, load.force));
      stiffness_(index.position, index.rotation) -= change.x;
      stiffness_(index.position + 1, index.rotation) -= change.y;
    } else {
      stiffness_(index.rotation, index.rotation) +=
          factor * dot(rotate(turn, load.arm), load.force);
    }
  }
  for (std::size_t i = 0; i < prescribed_count(); ++i) {
    const PrescribedPlace place = prescribed_place(i, moment.q);
    const Eigen::Index row = moving_ + static_cast<Eigen::Index>(i);
    for (int c = 0; c < 2; ++c) {
      if (place.unknowns[c] < 0) continue;
      stiffness_(row, place.unknowns[c]) -= place.slopes[c];
      stiffness_(place.unknowns[c], row) -= place.slopes[c];
    }
    if (place.unknowns[1] >= 0)
      stiffness_(place.unknowns[1], place.unknowns[1]) -=
          prescribed_reaction(i, moment.multipliers) * place.curvature;
  }
}

/// The base end moves with its body: u + turn x arm, in axes of the base section.
auto MotionSystem::outer_map(std::size_t member) const -> OuterMap {
  const auto& unknowns = numbering_.members[member].unknowns;
  const Placed& placed = placed_[member];
  OuterMap map;
  map.matrix.setZero();
  const int load = static_cast<int>(moving_ + load_row(member));
  for (int i = 0; i < 3; ++i) {
    map.columns[static_cast<std::size_t>(i)] = load + i;
    map.matrix(i, i) = 1.0;
  }
  map.columns[3] = unknowns[base_x];
  map.columns[4] = unknowns[base_y];
  map.columns[5] = unknowns[base_turn];
  map.columns[6] = unknowns[PortUnknown::base_section];
  const double turn = linearised() ? 0.0 : placed.turn;
  const Vec2 columns[3] = {rotate(-turn, {1.0, 0.0}), rotate(-turn, {0.0, 1.0}),
                           rotate(-turn, perp(placed.arm))};
  for (int c = 0; c < 3; ++c) {
    map.matrix(3, 3 + c) = columns[c].x;
    map.matrix(4, 3 + c) = columns[c].y;
  }
  map.matrix(5, 6) = 1.0;
  return map;
}

template <class T>
void MotionSystem::add_member_matrix(std::size_t member, T mass, T elastic,
                                     MotionFactor<T>& factor) const {
  MemberFactor<T>& inner = factor.members[member];
  inner.factorize(members_[member], mass, elastic);
  const OuterMap map = outer_map(member);
  const Eigen::Matrix<T, 7, 7> block =
      map.matrix.transpose().template cast<T>() * inner.outer * map.matrix.template cast<T>();
  for (std::size_t i = 0; i < 7; ++i)
    for (std::size_t j = 0; j < 7; ++j)
      if (map.columns[i] >= 0 && map.columns[j] >= 0)
        factor.matrix(map.columns[i], map.columns[j]) +=
            block(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
}

/// Rayleigh's damping goes with mass and stiffness.
template <class T>
bool MotionSystem::factorize(T mass, T damping, MotionFactor<T>& factor) const {
  const T all_mass = mass + layout_.mass_damping * damping;
  const T elastic = layout_.stiffness_damping * damping;
  factor.members.resize(members_.size());
  factor.matrix = stiffness_.template cast<T>() + damping * damping_.template cast<T>();
  factor.matrix.diagonal().head(moving_) += all_mass * mass_.template cast<T>();
  for (std::size_t k = 0; k < members_.size(); ++k) add_member_matrix(k, all_mass, elastic, factor);
  for (Eigen::Index j = 0; j < factor.matrix.cols(); ++j)
    factor.matrix.col(j).array() *= scale_[j] * scale_.array().template cast<T>();
  factor.reduced.compute(factor.matrix);
  const auto pivots = factor.reduced.matrixLU().diagonal().cwiseAbs().eval();
  if (pivots.size() == 0) return true;
  const double ratio = pivots.minCoeff() / pivots.maxCoeff();
  return std::isfinite(ratio) && ratio > 0.0;
}

/// Every constraint adds one eigenvalue of each sign to those of what it allows.
std::optional<int> MotionSystem::negative(const MotionFactor<double>& factor) const {
  SymmetricFactor reduced;
  if (!reduced.factorize(factor.matrix)) return std::nullopt;
  int sum = reduced.negative() - static_cast<int>(multipliers_);
  for (const MemberFactor<double>& member : factor.members) sum += member.negative;
  return sum;
}

template <class T>
void MotionSystem::solve(const MotionFactor<T>& factor, VectorX<T>& b) const {
  VectorX<T> reduced(moving_ + multipliers_);
  reduced << b.head(moving_), b.tail(multipliers_);
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const MemberFactor<T>& inner = factor.members[k];
    T* own = b.data() + internal_[k];
    inner.solve(own, port(k).layout());
    const Eigen::Map<const VectorX<T>> solved(own, inner.coupling.rows());
    const OuterMap map = outer_map(k);
    const Eigen::Matrix<T, 7, 1> outer =
        map.matrix.transpose().template cast<T>() * (inner.coupling.transpose() * solved);
    for (std::size_t i = 0; i < 7; ++i)
      if (map.columns[i] >= 0) reduced[map.columns[i]] -= outer[static_cast<Eigen::Index>(i)];
  }
  reduced.array() *= scale_.array().template cast<T>();
  reduced = factor.reduced.solve(reduced).eval();
  reduced.array() *= scale_.array().template cast<T>();
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const OuterMap map = outer_map(k);
    Eigen::Matrix<T, 7, 1> at;
    for (std::size_t i = 0; i < 7; ++i)
      at[static_cast<Eigen::Index>(i)] = map.columns[i] >= 0 ? reduced[map.columns[i]] : T{};
    const Eigen::Matrix<T, MemberMotion::outer, 1> outer = map.matrix.template cast<T>() * at;
    b.segment(internal_[k], factor.members[k].solved.rows()).noalias() -=
        factor.members[k].solved * outer;
  }
  b.head(moving_) = reduced.head(moving_);
  b.tail(multipliers_) = reduced.tail(multipliers_);
}

template bool MotionSystem::factorize(double, double, MotionFactor<double>&) const;
template bool MotionSystem::factorize(std::complex<double>, std::complex<double>,
                                      MotionFactor<std::complex<double>>&) const;
template void MotionSystem::solve(const MotionFactor<double>&, VectorX<double>&) const;
template void MotionSystem::solve(const MotionFactor<std::complex<double>>&,
                                  VectorX<std::complex<double>>&) const;

void MotionSystem::dense(Eigen::MatrixXd& stiffness, Eigen::MatrixXd& mass) const {
  const Eigen::Index n = coordinates_;
  stiffness.setZero(size(), size());
  mass.setZero(n, n);
  // places of the reduced unknowns
  std::vector<Eigen::Index> at;
  for (Eigen::Index i = 0; i < moving_; ++i) at.push_back(i);
  for (Eigen::Index i = 0; i < multipliers_; ++i) at.push_back(n + i);
  for (Eigen::Index i = 0; i < stiffness_.rows(); ++i)
    for (Eigen::Index j = 0; j < stiffness_.cols(); ++j)
      stiffness(at[static_cast<std::size_t>(i)], at[static_cast<std::size_t>(j)]) +=
          stiffness_(i, j);
  mass.diagonal().head(moving_) = mass_;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const MemberMotion& member = members_[k];
    const BandLayout layout = member.port().layout();
    const Eigen::Index first = internal_[k];
    for (std::size_t i = 0; i < layout.n; ++i)
      for (std::size_t j = i > layout.width ? i - layout.width : 0; j <= i; ++j) {
        const Eigen::Index r = first + static_cast<Eigen::Index>(i);
        const Eigen::Index c = first + static_cast<Eigen::Index>(j);
        stiffness(r, c) = stiffness(c, r) = layout.row(member.stiffness().data(), i)[j];
        mass(r, c) = mass(c, r) = layout.row(member.mass().data(), i)[j];
      }
    const OuterMap map = outer_map(k);
    const auto add = [&](Eigen::MatrixXd& whole, const MemberMotion::Coupling& coupling,
                         const MemberMotion::Outer& outer) {
      const Eigen::MatrixXd inner = coupling * map.matrix;
      const Eigen::Matrix<double, 7, 7> block = map.matrix.transpose() * outer * map.matrix;
      for (std::size_t i = 0; i < 7; ++i) {
        if (map.columns[i] < 0) continue;
        const Eigen::Index c = at[static_cast<std::size_t>(map.columns[i])];
        if (c >= whole.cols()) continue;  // multipliers have no mass
        const auto own = static_cast<Eigen::Index>(i);
        whole.block(first, c, inner.rows(), 1) += inner.col(own);
        whole.block(c, first, 1, inner.rows()) += inner.col(own).transpose();
        for (std::size_t j = 0; j < 7; ++j) {
          if (map.columns[j] < 0) continue;
          const Eigen::Index d = at[static_cast<std::size_t>(map.columns[j])];
          if (d < whole.cols()) whole(c, d) += block(own, static_cast<Eigen::Index>(j));
        }
      }
    };
    add(stiffness, member.stiffness_coupling(), member.outer_stiffness());
    add(mass, member.mass_coupling(), member.outer_mass());
  }
}

Eigen::VectorXd MotionSystem::multiply_mass(const Eigen::VectorXd& x) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(coordinates_);
  y.head(moving_) = mass_.cwiseProduct(x.head(moving_));
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const MemberMotion& member = members_[k];
    const BandLayout layout = member.port().layout();
    const OuterMap map = outer_map(k);
    Eigen::Matrix<double, 7, 1> at;
    for (std::size_t i = 0; i < 7; ++i) {
      const bool moves = i >= 3 && map.columns[i] >= 0;
      at[static_cast<Eigen::Index>(i)] = moves ? x[map.columns[i]] : 0.0;
    }
    const Eigen::Matrix<double, MemberMotion::outer, 1> outer = map.matrix * at;
    multiply_symmetric(member.mass().data(), layout, x.data() + internal_[k],
                       y.data() + internal_[k]);
    const auto own = static_cast<Eigen::Index>(layout.n);
    y.segment(internal_[k], own) += member.mass_coupling() * outer;
    const Eigen::Matrix<double, 7, 1> back =
        map.matrix.transpose() *
        (member.mass_coupling().transpose() * x.segment(internal_[k], own) +
         member.outer_mass() * outer);
    for (std::size_t i = 3; i < 7; ++i)
      if (map.columns[i] >= 0) y[map.columns[i]] += back[static_cast<Eigen::Index>(i)];
  }
  return y;
}

Eigen::VectorXd MotionSystem::constraint_rates(const Moment& moment) const {
  Eigen::VectorXd rates = Eigen::VectorXd::Zero(multipliers_);
  for (std::size_t i = 0; i < prescribed_count(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const PrescribedPlace place = prescribed_place(i, moment.q);
    rates[row] = layout_.mechanism.prescribed[i].value *
                 evaluate_history(layout_.prescribed[i], moment.time).rate;
    for (int c = 0; c < 2; ++c)
      if (place.unknowns[c] >= 0) rates[row] -= place.slopes[c] * moment.v[place.unknowns[c]];
  }
  const auto& joints = layout_.mechanism.joints;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const auto gaps = gaps_of(k, moment.q);
    const auto unknowns = pair_unknowns(joints[k].base, joints[k].action);
    for (std::size_t c = 0; c < 2; ++c)
      for (std::size_t i = 0; i < 6; ++i)
        if (unknowns[i] >= 0)
          rates[joint_row(k) + static_cast<Eigen::Index>(c)] -=
              gaps[c].gradient[i] * moment.v[unknowns[i]];
  }
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const auto& unknowns = numbering_.members[k].unknowns;
    auto own = rates.segment<3>(load_row(k));
    for (int i = 0; i < port_unknowns; ++i)
      if (unknowns[i] >= 0) own += placed_[k].relative.jacobian.col(i) * moment.v[unknowns[i]];
    const double* v = moment.v.data() + internal_[k];
    for (std::size_t i = 0; i < port(k).internal_size(); ++i)
      own += v[i] * members_[k].minus_tip_slope(i);
  }
  return rates;
}

}  // namespace flexura

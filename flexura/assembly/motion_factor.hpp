#pragma once

#include <Eigen/Dense>
#include <vector>

#include "flexura/assembly/member_motion.hpp"
#include "flexura/core/ldlt.hpp"
#include "flexura/core/symmetric_factor.hpp"

namespace flexura {

template <class T>
using VectorX = Eigen::Matrix<T, Eigen::Dynamic, 1>;
template <class T>
using MatrixX = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

/// A flexure's internal block of stiffness + mass factor * mass, factorized, and what eliminating
/// it leaves to the outer unknowns. T is double or complex.
template <class T>
struct MemberFactor {
  using Coupling = Eigen::Matrix<T, Eigen::Dynamic, MemberMotion::outer, Eigen::RowMajor>;
  using Outer = Eigen::Matrix<T, MemberMotion::outer, MemberMotion::outer>;

  std::vector<T> band;
  std::vector<T> column;
  Coupling coupling;                      ///< internal by outer unknowns
  Coupling solved;                        ///< inverse of the block times that
  Outer outer;                            ///< of the outer unknowns, the internal ones eliminated
  Eigen::PartialPivLU<MatrixX<T>> dense;  ///< where a pivot of the band was weak
  bool is_dense = false;
  int negative = 0;  ///< pivots of the block, where T is double

  /// Of stiffness + mass factor * mass + elastic factor * elastic stiffness.
  void factorize(const MemberMotion& member, T mass, T elastic);
  /// In place, of one right-hand side.
  void solve(T* b, const BandLayout& layout) const;

 private:
  void fill_band(const MemberMotion& member, T mass, T elastic);
  void pivot(const BandLayout& layout);
};

template <class T>
void MemberFactor<T>::fill_band(const MemberMotion& member, T mass, T elastic) {
  const std::vector<double>& k = member.stiffness();
  const std::vector<double>& m = member.mass();
  band.resize(k.size());
  for (std::size_t i = 0; i < k.size(); ++i) band[i] = k[i] + mass * m[i];
  for (std::size_t i = 0; i < member.elastic().size(); ++i)
    band[i] += elastic * member.elastic()[i];
}

template <class T>
void MemberFactor<T>::factorize(const MemberMotion& member, T mass, T elastic) {
  const BandLayout layout = member.port().layout();
  fill_band(member, mass, elastic);
  column.resize(layout.n);
  coupling = member.stiffness_coupling().template cast<T>() +
             mass * member.mass_coupling().template cast<T>();
  outer =
      member.outer_stiffness().template cast<T>() + mass * member.outer_mass().template cast<T>();
  solved = coupling;
  const LdltInertia inertia = factorize_ldlt(band.data(), layout, column.data());
  is_dense = inertia.weak;
  negative = inertia.negative;
  if (!is_dense) {
    solve_ldlt<MemberMotion::outer>(band.data(), layout, solved.data());
  } else {
    fill_band(member, mass, elastic);
    pivot(layout);
    solved = dense.solve(coupling).eval();
  }
  outer.noalias() -= coupling.transpose() * solved;
}

template <class T>
void MemberFactor<T>::pivot(const BandLayout& layout) {
  const auto n = static_cast<Eigen::Index>(layout.n);
  MatrixX<T> whole = MatrixX<T>::Zero(n, n);
  for (std::size_t i = 0; i < layout.n; ++i)
    for (std::size_t j = i > layout.width ? i - layout.width : 0; j <= i; ++j) {
      const auto r = static_cast<Eigen::Index>(i);
      const auto c = static_cast<Eigen::Index>(j);
      whole(r, c) = whole(c, r) = layout.row(band.data(), i)[j];
    }
  dense.compute(whole);
  if constexpr (std::is_same_v<T, double>) {
    SymmetricFactor pivoted;
    pivoted.factorize(whole);
    negative = pivoted.negative();
  }
}

template <class T>
void MemberFactor<T>::solve(T* b, const BandLayout& layout) const {
  if (!is_dense) {
    solve_ldlt<1>(band.data(), layout, b);
    return;
  }
  Eigen::Map<VectorX<T>> map(b, static_cast<Eigen::Index>(layout.n));
  map = dense.solve(map).eval();
}

/// Stiffness + mass factor * mass + damping factor * damping of a whole mechanism, factorized.
template <class T>
struct MotionFactor {
  std::vector<MemberFactor<T>> members;
  Eigen::PartialPivLU<MatrixX<T>> reduced;
  MatrixX<T> matrix;  ///< what is factorized there
};

}  // namespace flexura

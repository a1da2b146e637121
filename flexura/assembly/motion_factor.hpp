#pragma once

#include <Eigen/Dense>
#include <vector>

#include "flexura/assembly/member_motion.hpp"
#include "flexura/core/ldlt.hpp"

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

  void factorize(const MemberMotion& member, T mass, T stiffness);
  /// In place, of one right-hand side.
  void solve(T* b, const BandLayout& layout) const;
};

template <class T>
void MemberFactor<T>::factorize(const MemberMotion& member, T mass, T stiffness) {
  const BandLayout layout = member.port().layout();
  const std::vector<double>& k = member.stiffness();
  const std::vector<double>& m = member.mass();
  band.resize(k.size());
  column.resize(layout.n);
  for (std::size_t i = 0; i < k.size(); ++i) band[i] = stiffness * k[i] + mass * m[i];
  coupling = member.stiffness_coupling().template cast<T>() +
             mass * member.mass_coupling().template cast<T>();
  outer =
      member.outer_stiffness().template cast<T>() + mass * member.outer_mass().template cast<T>();
  solved = coupling;
  is_dense = factorize_ldlt(band.data(), layout, column.data()).weak;
  if (!is_dense) {
    solve_ldlt<MemberMotion::outer>(band.data(), layout, solved.data());
  } else {
    const auto n = static_cast<Eigen::Index>(layout.n);
    MatrixX<T> whole = MatrixX<T>::Zero(n, n);
    for (std::size_t i = 0; i < layout.n; ++i)
      for (std::size_t j = i > layout.width ? i - layout.width : 0; j <= i; ++j) {
        const auto r = static_cast<Eigen::Index>(i);
        const auto c = static_cast<Eigen::Index>(j);
        whole(r, c) = whole(c, r) =
            stiffness * layout.row(k.data(), i)[j] + mass * layout.row(m.data(), i)[j];
      }
    dense.compute(whole);
    solved = dense.solve(coupling).eval();
  }
  outer.noalias() -= coupling.transpose() * solved;
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
  MatrixX<T> matrix;  ///< scratch
};

}  // namespace flexura

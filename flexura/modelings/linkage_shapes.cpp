#include "flexura/modelings/linkage_shapes.hpp"

#include <Eigen/Sparse>
#include <optional>
#include <vector>

#include "flexura/solvers/vibration.hpp"

namespace flexura {
namespace {

constexpr Eigen::Index many_unknowns = 200;
using Sparse = Eigen::SparseMatrix<double>;
using Indices = std::vector<Eigen::Index>;

/// Unknowns that the tip depends on, if they are three.
std::optional<Indices> tip_unknowns(const Eigen::MatrixXd& tip) {
  Indices own;
  for (Eigen::Index j = 0; j < tip.cols(); ++j)
    if (tip.col(j).cwiseAbs().maxCoeff() > 0.0) own.push_back(j);
  if (own.size() != 3) return std::nullopt;
  return own;
}

/// Vibrations of a sparse matrix that is positive definite.
class SparseVibrations final : public VibrationOperator {
 public:
  SparseVibrations(const Sparse& stiffness, const Sparse& mass)
      : stiffness_(stiffness), mass_(mass) {
    factor_.analyzePattern(stiffness_ + mass_);
  }
  Eigen::Index size() const override { return mass_.rows(); }
  Eigen::Index most_rigid() const override { return 0; }
  bool set_shift(double shift) override {
    factor_.factorize(stiffness_ + shift * mass_);
    return factor_.info() == Eigen::Success;
  }
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const override { return factor_.solve(b); }
  Eigen::VectorXd multiply_mass(const Eigen::VectorXd& x) const override { return mass_ * x; }
  std::optional<int> count_below(double square) const override {
    Eigen::SimplicialLDLT<Sparse> factor;
    factor.compute(stiffness_ - square * mass_);
    if (factor.info() != Eigen::Success) return std::nullopt;
    return static_cast<int>((factor.vectorD().array() < 0.0).count());
  }

 private:
  Sparse stiffness_, mass_;
  Eigen::SimplicialLDLT<Sparse> factor_;
};

/// All at once, with the tip's equations bordered.
HeldShapes dense_shapes(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                        const Eigen::MatrixXd& tip, int count) {
  const Eigen::Index m = stiffness.rows();
  Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(m + 3, m + 3);
  bordered.topLeftCorner(m, m) = stiffness;
  bordered.bottomLeftCorner(3, m) = tip;
  bordered.topRightCorner(m, 3) = tip.transpose();
  Eigen::MatrixXd units = Eigen::MatrixXd::Zero(m + 3, 3);
  units.bottomRows<3>().setIdentity();
  HeldShapes shapes{bordered.partialPivLu().solve(units).topRows(m), Eigen::MatrixXd(m, 0)};
  if (count <= 0) return shapes;
  const Vibrations held = dense_vibrations(stiffness, mass, tip, count);
  if (held.found) shapes.vibrations = held.shapes;
  return shapes;
}

HeldShapes sparse_shapes(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                         const Eigen::MatrixXd& tip, const Indices& own, int count) {
  Indices others;
  for (Eigen::Index j = 0; j < tip.cols(); ++j)
    if (tip.col(j).cwiseAbs().maxCoeff() == 0.0) others.push_back(j);
  const Sparse k = stiffness(others, others).eval().sparseView();
  const Sparse m = mass(others, others).eval().sparseView();
  const Eigen::Matrix3d by_tip = Eigen::Matrix3d(tip(Eigen::all, own)).inverse();
  HeldShapes shapes{Eigen::MatrixXd::Zero(tip.cols(), 3), Eigen::MatrixXd(tip.cols(), 0)};
  const Eigen::SimplicialLDLT<Sparse> factor(k);
  shapes.by_tip(own, Eigen::all) = by_tip;
  shapes.by_tip(others, Eigen::all) = -factor.solve(stiffness(others, own) * by_tip);
  SparseVibrations op(k, m);
  const Vibrations held = sparse_vibrations(op, count);
  if (!held.found) return shapes;
  shapes.vibrations = Eigen::MatrixXd::Zero(tip.cols(), held.shapes.cols());
  shapes.vibrations(others, Eigen::all) = held.shapes;
  return shapes;
}

}  // namespace

HeldShapes held_shapes(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                       const Eigen::MatrixXd& tip, int count) {
  const auto own = tip_unknowns(tip);
  if (own && tip.cols() > many_unknowns) return sparse_shapes(stiffness, mass, tip, *own, count);
  return dense_shapes(stiffness, mass, tip, count);
}

}  // namespace flexura

// What every modeling's flexure, by itself, must satisfy (property_suite.hpp).
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "flexura/modelings/compliance.hpp"
#include "flexura/modelings/make_system.hpp"
#include "tests/modelings/property_suite.hpp"
#include "tests/support/measured.hpp"

namespace flexura::testing {
namespace {

/// One flexure held at its base: a port, and its internal unknowns solved for a load on the tip.
class TwoPortProperties : public ::testing::TestWithParam<SuiteEntry> {
 protected:
  struct Answer {
    TipResponse response;
    std::vector<double> internal;
    std::vector<double> steps;  ///< sizes of the internal Newton steps
  };

  Answer answer(const Eigen::Vector3d& load) const {
    Answer answer;
    answer.internal.assign(port().internal_size(), 0.0);
    // from rest at once, but for meshes whose coarse elements would leave Newton's basin
    if (is_continuum())
      for (const double share : {0.25, 0.5, 0.75}) iterate(share * load, answer);
    iterate(load, answer);
    EXPECT_LT(answer.steps.back(), 1e-10);
    return answer;
  }
  void iterate(const Eigen::Vector3d& load, Answer& answer) const {
    std::vector<double> scratch(port().scratch_size());
    std::vector<double> step(port().internal_size());
    answer.steps.clear();
    for (int k = 0; k < 25; ++k) {
      answer.response = port().linearize(load, answer.internal.data(), scratch.data());
      port().advance(scratch.data(), 1.0, Eigen::Vector3d::Zero(), step.data());
      double size = 0.0;
      for (std::size_t i = 0; i < step.size(); ++i) {
        answer.internal[i] += step[i];
        size = std::max(size, std::abs(step[i]));
      }
      answer.steps.push_back(size);
      if (size < 1e-14 ||
          (size < 1e-11 && k > 0 && size > 0.1 * answer.steps[answer.steps.size() - 2]))
        break;
    }
    answer.response = port().linearize(load, answer.internal.data(), scratch.data());
  }
  static bool is_continuum() {
    return std::holds_alternative<ContinuumSettings>(GetParam().settings.kind);
  }
  const TwoPort& port() const { return *layout_.members[0].port; }
  /// From the base end to the point that the tip's load acts at, as drawn.
  Vec2 drawn_tip() const {
    const AxisEnds ends = axis_ends(chain_.model().flexures[0].axis);
    return ends.action + layout_.members[0].arms.tip - ends.base;
  }
  /// Bends the flexure by some tenths of a radian.
  static Eigen::Vector3d some_load() { return {0.04, -0.05, 0.2}; }

  const Mechanism chain_ = suite_chain(GetParam());
  const SystemLayout layout_ = make_layout(chain_, {}, GetParam().settings);
};

TEST_P(TwoPortProperties, IsFreeOfStressAsDrawn) {
  const Answer rest = answer(Eigen::Vector3d::Zero());
  const Vec2 tip = drawn_tip();
  EXPECT_LT((rest.response.tip - Eigen::Vector3d(tip.x, tip.y, 0.0)).norm(), 1e-13);
  EXPECT_NEAR(rest.response.strain_energy, 0.0, 1e-16 * 2100.0);  // rounding of the modulus
  EXPECT_EQ(rest.response.negative, 0);
  for (const double y : rest.internal) EXPECT_NEAR(y, 0.0, 1e-13);
  const AxisCurve axis(chain_.model().flexures[0].axis);
  const auto stations = port().sections(Eigen::Vector3d::Zero(), rest.internal);
  ASSERT_EQ(stations.size(), static_cast<std::size_t>(station_count));
  for (std::size_t k = 0; k < stations.size(); ++k) {
    const double s = axis.length() * static_cast<double>(k) / (station_count - 1);
    EXPECT_LT(norm(stations[k].pose.position - (axis.position(s) - axis.position(0.0))), 1e-13);
    EXPECT_NEAR(stations[k].pose.rotation, 0.0, 1e-13);
    EXPECT_NEAR(stations[k].bending_moment, 0.0, 1e-13);
    EXPECT_EQ(stations[k].axial_force, 0.0);
    EXPECT_EQ(stations[k].shear_force, 0.0);
  }
}

/// W(load) = strain energy - load . tip is the potential of the tip: dW = -tip . d(load).
TEST_P(TwoPortProperties, TipIsTheGradientOfThePotential) {
  const auto potential = [&](const Eigen::Vector3d& load) {
    const Answer a = answer(load);
    return a.response.strain_energy - load.dot(a.response.tip);
  };
  const Answer here = answer(some_load());
  const double h = 1e-4;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
    // fourth-order differences
    const double slope = (8.0 * (potential(some_load() + step) - potential(some_load() - step)) -
                          potential(some_load() + 2 * step) + potential(some_load() - 2 * step)) /
                         (12.0 * h);
    EXPECT_NEAR(slope, -here.response.tip[k], 2e-10 * here.response.tip.norm());
  }
}

TEST_P(TwoPortProperties, FlexibilityIsTheDerivativeOfTheTipAndSymmetric) {
  const Answer here = answer(some_load());
  const double h = 1e-4;
  const double size = here.response.flexibility.norm();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
    const auto tip = [&](double times) { return answer(some_load() + times * step).response.tip; };
    const Eigen::Vector3d slope = (8.0 * (tip(1) - tip(-1)) - tip(2) + tip(-2)) / (12.0 * h);
    EXPECT_LT((slope - here.response.flexibility.col(k)).norm(), 1e-9 * size);
  }
  EXPECT_LT((here.response.flexibility - here.response.flexibility.transpose()).norm(),
            1e-13 * size);
}

/// The internal tangent is the derivative of the internal residual: Newton's rate is quadratic,
/// with a constant of order one where forces are unknowns, and of the squared slenderness in
/// displacements (more where nodal curvatures are unknowns, too).
TEST_P(TwoPortProperties, InternalNewtonStepsShrinkQuadratically) {
  if (port().internal_size() == 0) GTEST_SKIP() << "nothing inside";
  const Answer here = answer(some_load());
  const auto* beam = std::get_if<BeamSettings>(&GetParam().settings.kind);
  if (beam && beam->theory == BeamSettings::Theory::linear) GTEST_SKIP() << "one step suffices";
  const bool curvatures = beam && beam->theory == BeamSettings::Theory::von_karman;
  const bool displacements = (beam && GetParam().settings.axial) || is_continuum();
  const double constant = curvatures ? 4000.0 : displacements ? 2000.0 : 20.0;
  bool seen = false;
  for (std::size_t k = 0; k + 1 < here.steps.size(); ++k) {
    const double size = here.steps[k];
    if (constant * size > 2.0 || size < 1e-7) continue;
    EXPECT_LT(here.steps[k + 1], constant * size * size + 1e-13) << k;
    seen = true;
  }
  EXPECT_TRUE(seen);
}

/// The forces at the stations balance the load on the tip: along the deformed axis, the moment
/// changes by the lever of the constant force.
TEST_P(TwoPortProperties, SectionForcesBalanceTheLoad) {
  const Answer here = answer(some_load());
  const auto* beam = std::get_if<BeamSettings>(&GetParam().settings.kind);
  const bool small = std::holds_alternative<LinearSettings>(GetParam().settings.kind) ||
                     std::holds_alternative<ScmbmSettings>(GetParam().settings.kind) ||
                     (beam && beam->theory == BeamSettings::Theory::linear);
  const AxisCurve axis(chain_.model().flexures[0].axis);
  const auto stations = port().sections(some_load(), here.internal);
  const Vec2 f{some_load()[0], some_load()[1]};
  for (std::size_t k = 0; k < stations.size(); ++k) {
    const SectionState& s = stations[k];
    const double at = axis.length() * static_cast<double>(k) / (station_count - 1);
    const Vec2 t = unit(axis.tangent_angle(at) + (small ? 0.0 : s.pose.rotation));
    EXPECT_LT(norm(s.axial_force * t + s.shear_force * perp(t) - f), 1e-13);
    const Vec2 place = small ? axis.position(at) - axis.position(0.0) : s.pose.position;
    const Vec2 tip = small ? drawn_tip() : stations.back().pose.position;
    EXPECT_NEAR(s.bending_moment, some_load()[2] + cross(tip - place, f), 1e-8);
  }
}

/// tip = drawn + C load + O(load^2): the deviation per load falls with the load.
TEST_P(TwoPortProperties, TendsToTheComplianceMatrixAsLoadsVanish) {
  const ModelingSettings& settings = GetParam().settings;
  const FlexureProperties flexure =
      flexure_properties(chain_, chain_.model().flexures[0], settings.axial, settings.shear);
  const Vec2 at = axis_ends(chain_.model().flexures[0].axis).action + layout_.members[0].arms.tip;
  const Eigen::Vector3d expected = compliance_matrix(flexure, at) * some_load();
  const Eigen::Vector3d drawn(drawn_tip().x, drawn_tip().y, 0.0);
  const auto deviation = [&](double factor) {
    const Eigen::Vector3d tip = answer(factor * some_load()).response.tip;
    return ((tip - drawn) / factor - expected).norm() / expected.norm();
  };
  const double before = deviation(1e-3);
  const double after = deviation(1e-4);
  note_measured("at_1e-4", after);
  if (!GetParam().linearizes) {
    EXPECT_GT(after, 2e-4) << "now it tends to it: enter it as linearizing";
    return;
  }
  EXPECT_LT(after, 1e-4);
  // first order, down to what rounding of the tip and the mesh leave
  EXPECT_LT(after, 0.11 * before + 2e-10);
}

INSTANTIATE_TEST_SUITE_P(Suite, TwoPortProperties, ::testing::ValuesIn(suite_entries()),
                         suite_name);

}  // namespace
}  // namespace flexura::testing

// What a mechanism must satisfy by every modeling (property_suite.hpp).
#include <algorithm>
#include <cmath>
#include <functional>

#include "flexura/modelings/make_system.hpp"
#include "flexura/solvers/newton.hpp"
#include "tests/modelings/property_suite.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/tracing.hpp"
#include "tests/support/transform.hpp"

namespace flexura::testing {
namespace {

class MechanismProperties : public ::testing::TestWithParam<SuiteEntry> {
 protected:
  Pose stage(const Model& model, const std::vector<Load>& loads, int steps = 4) const {
    return final_pose(model, loads, GetParam().settings, chain_.index("stage"), steps);
  }
  Pose stage() const { return stage(chain_, loads_); }

  const Mechanism chain_ = suite_chain(GetParam());
  const std::vector<Load> loads_ = suite_loads(chain_);
};

/// The loads are not small: otherwise the properties below would say little.
TEST_P(MechanismProperties, TheSuitesLoadsAreLarge) {
  EXPECT_GT(std::abs(stage().rotation), 0.2);
  EXPECT_LT(std::abs(stage().rotation), 3.0);
}

TEST_P(MechanismProperties, DoNotChangeWhenTheWholeIsMovedRigidly) {
  const double angle = 2.1;
  const Vec2 shift{-30.0, 47.0};
  std::vector<Load> loads;
  for (const Load& load : loads_) loads.push_back(turned(load, angle));
  const Pose moved = stage(moved_rigidly(chain_, angle, shift), loads);
  Pose expected = stage();
  expected.position = shift + rotate(angle, expected.position);
  note_measured("difference", distance(moved, expected, 10.0));
  EXPECT_LT(distance(moved, expected, 10.0), 1e-11);
}

TEST_P(MechanismProperties, AreTheSameInMillimetresAndMetres) {
  std::vector<Load> loads;
  for (const Load& load : loads_) loads.push_back(in_other_length_unit(load, 1e-3));
  Pose metres = stage(in_other_length_unit(chain_, 1e-3), loads);
  metres.position = 1e3 * metres.position;
  note_measured("difference", distance(metres, stage(), 10.0));
  EXPECT_LT(distance(metres, stage(), 10.0), 1e-12);
}

TEST_P(MechanismProperties, DoNotDependOnWhichEndOfAFlexureIsTheBase) {
  const Pose expected = stage();
  const double difference =
      std::max(distance(stage(with_reversed_flexure(chain_, 0), loads_), expected, 10.0),
               distance(stage(with_reversed_flexure(chain_, 1), loads_), expected, 10.0));
  note_measured("difference", difference);
  if (GetParam().reversible)
    EXPECT_LT(difference, 1e-11);
  else
    EXPECT_GT(difference, 1e-6) << "now it does: enter it as reversible";
}

/// To what is left of the discretizations' errors, those of the beams being 1e-9 here.
TEST_P(MechanismProperties, DoNotChangeWhenAFlexureIsCutAndJoinedAgain) {
  const Pose expected = stage();
  const double difference =
      std::max(distance(stage(with_halved_flexure(chain_, 0), loads_), expected, 10.0),
               distance(stage(with_halved_flexure(chain_, 1), loads_), expected, 10.0));
  note_measured("difference", difference);
  if (GetParam().divisible)
    EXPECT_LT(difference, 2e-8);
  else
    EXPECT_GT(difference, 1e-6) << "now they are equal: enter it as divisible";
}

TEST_P(MechanismProperties, DoNotDependOnTheNumberOfSteps) {
  const Pose expected = stage(chain_, loads_, 1);
  for (const int steps : {2, 7, 50})
    EXPECT_LT(distance(stage(chain_, loads_, steps), expected, 10.0), 1e-10) << steps;
}

/// Along the path d(strain energy) = f d(displacement of the loads): by Simpson's rule over the
/// load factor f, E(1) = D(1) - integral of D(f).
TEST_P(MechanismProperties, StrainEnergyIsTheWorkOfTheLoads) {
  const int steps = 64;
  const TracedPath path = trace(chain_, loads_, GetParam().settings, steps, false);
  ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
  double integral = 0.0;
  for (int k = 0; k <= steps; ++k) {
    const TracedState& at = path.states[static_cast<std::size_t>(k)];
    const double weight = k == 0 || k == steps ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
    integral += weight / (3.0 * steps) * path.systems[at.system]->load_displacement(at.z);
  }
  const TracedState& last = path.states.back();
  System& system = *path.systems[last.system];
  ASSERT_TRUE(system.linearize(last.z));
  const double work = system.load_displacement(last.z) - integral;
  note_measured("relative", std::abs(system.strain_energy() / work - 1.0));
  EXPECT_NEAR(system.strain_energy(), work, 1e-6 * work);
}

/// The tangent of the whole: dz/d(load factor) against differences of equilibria, by dead loads and
/// by loads that follow.
TEST_P(MechanismProperties, TangentIsTheDerivativeOfTheResidual) {
  for (const bool follower : {false, true}) {
    std::vector<Load> loads = loads_;
    for (Load& load : loads) load.follower = follower;
    const TracedPath path = trace(chain_, loads, GetParam().settings, 4, false);
    ASSERT_TRUE(path.termination.converged()) << path.termination.reason;
    const TracedState& last = path.states.back();
    System& system = *path.systems[last.system];
    const double h = 1e-3;
    const auto solved = [&](double factor) {
      std::vector<double> z = last.z;
      system.set_load_factor(factor);
      EXPECT_EQ(Newton({1e-13, 30, 6}).solve(system, z).outcome, NewtonOutcome::converged);
      return z;
    };
    const auto low = solved(1 - h), high = solved(1 + h);
    const auto lower = solved(1 - 2 * h), higher = solved(1 + 2 * h);
    const auto here = solved(1.0);
    ASSERT_TRUE(system.linearize(here));
    std::vector<double> direction;
    system.load_direction(direction);
    double size = 0.0;
    for (const double d : direction) size = std::max(size, std::abs(d));
    for (std::size_t i = 0; i < direction.size(); ++i) {
      const double slope = (8.0 * (high[i] - low[i]) - (higher[i] - lower[i])) / (12.0 * h);
      EXPECT_NEAR(slope, direction[i], 1e-7 * size) << i << (follower ? " follower" : " dead");
    }
  }
}

/// What a body displaces per load on it is symmetric wherever loads have a potential.
TEST_P(MechanismProperties, CompliancesAreSymmetric) {
  const TracedPath path = trace(chain_, loads_, GetParam().settings, 4, false);
  const TracedState& last = path.states.back();
  System& system = *path.systems[last.system];
  system.set_load_factor(1.0);
  ASSERT_TRUE(system.linearize(last.z));
  for (const std::size_t body : {1U, 2U}) {
    const Eigen::Matrix3d c = system.body_compliance(body);
    EXPECT_LT((c - c.transpose()).norm(), 1e-12 * c.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Suite, MechanismProperties, ::testing::ValuesIn(suite_entries()),
                         suite_name);

}  // namespace
}  // namespace flexura::testing

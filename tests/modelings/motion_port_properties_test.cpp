// What every modeling's flexure in motion must satisfy, by itself (property_suite.hpp).
#include <cmath>
#include <optional>
#include <random>

#include "flexura/modelings/make_motion.hpp"
#include "flexura/modelings/make_system.hpp"
#include "tests/modelings/property_suite.hpp"
#include "tests/support/plane_mesh.hpp"

namespace flexura::testing {
namespace {

/// With the places where inertia can be besides the usual ones.
struct MovingEntry : SuiteEntry {
  InertiaSettings inertia;
  std::optional<ElementKind> mesh;  ///< of the first flexure: a link of any shape
};

std::vector<MovingEntry> moving_entries() {
  std::vector<MovingEntry> entries;
  const auto add = [&](SuiteEntry entry, const std::string& suffix, bool shear, bool lumped) {
    entry.name += suffix;
    entries.push_back({std::move(entry), {true, true, shear, lumped}, {}});
  };
  std::vector<SuiteEntry> suite = suite_entries();
  SuiteEntry stiff{"beam_order_3_unstretchable", beam(6, 3)};
  stiff.settings.axial = false;
  suite.push_back(stiff);
  for (const SuiteEntry& entry : suite) {
    if (entry.name == "printed") continue;
    add(entry, "", true, false);
    const bool is_beam = std::holds_alternative<BeamSettings>(entry.settings.kind);
    if (is_beam) add(entry, "_lumped", true, true);
    if (!entry.settings.shear) continue;
    if (is_beam || entry.name == "exact") add(entry, "_rayleigh", false, false);
    if (is_beam) add(entry, "_lumped_rayleigh", false, true);
  }
  for (const ElementKind kind : {ElementKind::triangle3, ElementKind::triangle6, ElementKind::quad4,
                                 ElementKind::quad8, ElementKind::quad9})
    entries.push_back({{"mesh_nodes_" + std::to_string(nodes_of(kind)), continuum(8, 1, 4)},
                       {true, true, true, false},
                       kind});
  return entries;
}

/// The first flexure of the suite's chain, meshed.
MeshLink meshed_arc(ElementKind kind) {
  return mapped_link(kind, 12, 2, [](Vec2 p) {
    return Vec2{0.0, 3.0} + (3.0 + 0.3 * (0.5 - p.y)) * unit(-1.5 + 2.6 * p.x);
  });
}

constexpr double density = 2.0;

class MotionPortProperties : public ::testing::TestWithParam<MovingEntry> {
 protected:
  MotionPortProperties() {
    chain_.materials.front().density = density;
    if (GetParam().mesh) {
      auto link = std::make_shared<MeshLink>(meshed_arc(*GetParam().mesh));
      chain_.flexures.front().axis = link_axis(*link);
      chain_.flexures.front().link = std::move(link);
    }
    inertia_ = GetParam().inertia;
    layout_ = make_motion_layout(chain_, {}, GetParam().settings, inertia_);
    work_ = sized_work(port());
    still_ = make_layout(chain_, {}, GetParam().settings);
  }

  const MotionPort& port() const { return *layout_.ports[0]; }
  std::size_t size() const { return port().internal_size(); }
  bool is_small() const { return layout_.mechanism.linearised; }

  /// Unknowns that bend the flexure, and differ from one another.
  std::vector<double> some_state(unsigned seed = 1) const {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::vector<double> y = port().weights();
    // nodes of a continuum that move apart strain it by what they are apart
    const double most = is_continuum() ? 0.01 : 0.1;
    for (double& v : y) v *= std::min(most, 1.0 / static_cast<double>(size())) * uniform(random);
    return y;
  }
  static bool is_continuum() {
    return std::holds_alternative<ContinuumSettings>(GetParam().settings.kind);
  }
  static Eigen::Vector3d some_load() { return {0.04, -0.05, 0.2}; }
  static std::vector<double> moved(const std::vector<double>& y, const std::vector<double>& by,
                                   double step) {
    std::vector<double> out = y;
    for (std::size_t i = 0; i < y.size(); ++i) out[i] += step * by[i];
    return out;
  }
  MotionPort::Answer evaluate(const std::vector<double>& y, MemberWork& work) const {
    return port().evaluate(some_load(), y.data(), y.data(), y.data(), work);
  }
  double potential(const std::vector<double>& y) const {
    MemberWork work = sized_work(port());
    const MotionPort::Answer answer = evaluate(y, work);
    return answer.energy - some_load().dot(answer.tip);
  }
  Eigen::MatrixXd tangent(const MemberWork& work) const {
    const BandLayout layout = port().layout();
    const auto n = static_cast<Eigen::Index>(size());
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t i = 0; i < size(); ++i)
      for (std::size_t j = i > layout.width ? i - layout.width : 0; j <= i; ++j) {
        const auto r = static_cast<Eigen::Index>(i), c = static_cast<Eigen::Index>(j);
        whole(r, c) = whole(c, r) = layout.row(work.tangent.data(), i)[j];
      }
    return whole;
  }

  Model chain_ = suite_chain(GetParam());
  InertiaSettings inertia_;
  MotionLayout layout_;
  SystemLayout still_;
  MemberWork work_;
};

INSTANTIATE_TEST_SUITE_P(Suite, MotionPortProperties, ::testing::ValuesIn(moving_entries()),
                         [](const auto& test) { return test.param.name; });

TEST_P(MotionPortProperties, RestsAsDrawn) {
  const std::vector<double> rest(size(), 0.0);
  const MotionPort::Answer answer =
      port().evaluate(Eigen::Vector3d::Zero(), rest.data(), rest.data(), rest.data(), work_);
  const AxisCurve axis(chain_.flexures[0].axis);
  EXPECT_NEAR(answer.energy, 0.0, 1e-14);
  for (std::size_t i = 0; i < size(); ++i) EXPECT_NEAR(work_.columns[4 * i], 0.0, 1e-11);
  double mass = 0.0, rotary = 0.0;
  for (std::size_t g = 0; g < port().points().size(); ++g) {
    const MassPoint& point = port().points()[g];
    (point.direction ? rotary : mass) += point.inertia;
    if (point.direction) {
      EXPECT_NEAR(norm(work_.places[g]), 1.0, 2e-2);  // along an interpolated axis, nearly
    } else if (!GetParam().mesh) {
      EXPECT_LT(norm(work_.places[g] - (axis.position(point.s) - axis.position(0.0))),
                is_continuum() ? 0.15 : 1e-13);
    }
  }
  if (GetParam().mesh) {
    EXPECT_NEAR(mass, density * mesh_area(chain_.flexures[0].link->mesh), 1e-12);
    return;
  }
  if (is_continuum()) {  // with its outline interpolated
    EXPECT_NEAR(mass, density * 0.3 * axis.length(), 2e-3 * mass);
    return;
  }
  EXPECT_NEAR(mass, density * 0.3 * axis.length(), 1e-12);
  EXPECT_NEAR(rotary, density * 0.3 * 0.3 * 0.3 / 12.0 * axis.length(), 1e-12);
}

TEST_P(MotionPortProperties, GradientIsThatOfThePotential) {
  const std::vector<double> y = some_state();
  evaluate(y, work_);
  const double step = is_continuum() ? 1e-5 : 1e-4;  // logarithms bend
  for (std::size_t i = 0; i < size(); ++i) {
    std::vector<double> one(size(), 0.0);
    one[i] = 1.0;
    const auto at = [&](double by) { return potential(moved(y, one, by)); };
    const double slope =
        (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step);
    EXPECT_NEAR(work_.columns[4 * i], slope, 1e-7 * (1.0 + std::abs(slope))) << i;
  }
}

TEST_P(MotionPortProperties, TangentIsThatOfGradientAndPlaces) {
  const std::vector<double> y = some_state();
  const std::vector<double> direction = some_state(2);
  std::vector<Vec2> weights;
  for (std::size_t g = 0; g < port().points().size(); ++g)
    weights.push_back({std::sin(1.0 + static_cast<double>(g)), std::cos(static_cast<double>(g))});
  const auto gradient = [&](double step) {
    MemberWork work = sized_work(port());
    evaluate(moved(y, direction, step), work);
    Eigen::VectorXd sum(static_cast<Eigen::Index>(size()));
    for (std::size_t i = 0; i < size(); ++i)
      sum[static_cast<Eigen::Index>(i)] = work.columns[4 * i];
    port().add_forces(weights.data(), work, sum.data());
    return sum;
  };
  const double step = 1e-5;
  const Eigen::VectorXd rate = (gradient(step) - gradient(-step)) / (2.0 * step);
  evaluate(y, work_);
  port().linearize(some_load(), y.data(), weights.data(), work_);
  const Eigen::VectorXd product =
      tangent(work_) * Eigen::Map<const Eigen::VectorXd>(direction.data(), rate.size());
  EXPECT_LT((product - rate).lpNorm<Eigen::Infinity>(),
            2e-7 * (1.0 + rate.lpNorm<Eigen::Infinity>()));
}

/// Along y(t) = y + v t + a t^2/2.
TEST_P(MotionPortProperties, RatesAndSlopesAreThoseOfThePlaces) {
  const std::vector<double> y = some_state();
  const std::vector<double> v = some_state(2);
  const std::vector<double> a = some_state(3);
  const auto places = [&](double t) {
    MemberWork work = sized_work(port());
    evaluate(moved(moved(y, v, t), a, 0.5 * t * t), work);
    return work.places;
  };
  const double h = 4e-4;
  const auto before = places(-h), here = places(0.0), after = places(h);
  const auto long_before = places(-2.0 * h), long_after = places(2.0 * h);
  port().evaluate(some_load(), y.data(), v.data(), a.data(), work_);
  port().linearize(some_load(), y.data(), nullptr, work_);
  const Vec2* slope = work_.slopes.data();
  for (std::size_t g = 0; g < here.size(); ++g) {
    Vec2 rate;
    const MassPoint& point = port().points()[g];
    for (std::size_t j = 0; j < point.count; ++j, ++slope)
      rate = rate + v[point.first + j] * *slope;
    EXPECT_LT(norm(rate - work_.rates[g]), 1e-12) << g;
    const Vec2 near = after[g] - before[g], far = long_after[g] - long_before[g];
    EXPECT_LT(norm(rate - (1.0 / (12.0 * h)) * (8.0 * near - far)), 1e-7) << g;
    const Vec2 second = (1.0 / (12.0 * h * h)) * (16.0 * (after[g] + before[g]) - 30.0 * here[g] -
                                                  long_after[g] - long_before[g]);
    EXPECT_LT(norm(second - work_.seconds[g]), 1e-6 * (1.0 + norm(second))) << g;
  }
}

/// Without inertia a flexure in motion answers a load on its tip as the one at rest does, since all
/// that differs is which unknowns are eliminated; `exact` has forces as modes: 1e-6 of a length.
TEST_P(MotionPortProperties, AnswersALoadAsAtRest) {
  const TwoPort& still = *still_.members[0].port;
  std::vector<double> internal(still.internal_size(), 0.0), scratch(still.scratch_size());
  std::vector<double> change(internal.size());
  for (int k = 0; k < 30; ++k) {
    still.linearize(std::min(1.0, 0.1 * (k + 1)) * some_load(), internal.data(), scratch.data());
    still.advance(scratch.data(), 1.0, Eigen::Vector3d::Zero(), change.data());
    for (std::size_t i = 0; i < internal.size(); ++i) internal[i] += change[i];
  }
  const Eigen::Vector3d expected =
      still.linearize(some_load(), internal.data(), scratch.data()).tip;
  std::vector<double> y = port().adopt(still.sections(some_load(), internal), internal);
  double first = 0.0;
  Eigen::Vector3d tip;
  for (int k = 0; k < 30; ++k) {
    tip = evaluate(y, work_).tip;
    if (k == 0) {
      EXPECT_LT((tip - expected).head<2>().norm(), 0.02 * 9.0) << "adopted";
    }
    Eigen::VectorXd residual(static_cast<Eigen::Index>(size()));
    for (std::size_t i = 0; i < size(); ++i)
      residual[static_cast<Eigen::Index>(i)] = work_.columns[4 * i];
    port().linearize(some_load(), y.data(), nullptr, work_);
    const Eigen::VectorXd step = tangent(work_).fullPivLu().solve(residual);
    for (std::size_t i = 0; i < size(); ++i) y[i] -= step[static_cast<Eigen::Index>(i)];
    first = step.lpNorm<Eigen::Infinity>();
    if (first < 1e-12) break;
  }
  tip = evaluate(y, work_).tip;
  const bool exact = std::holds_alternative<ExactSettings>(GetParam().settings.kind);
  const double tolerance = exact ? 1e-7 : 1e-9;
  EXPECT_LT((tip - expected).head<2>().norm(), tolerance * 9.0);
  EXPECT_NEAR(tip[2], expected[2], tolerance);
  const auto stations = port().sections(some_load(), y.data());
  const auto expected_stations = still.sections(some_load(), internal);
  for (std::size_t k = 0; k < stations.size(); ++k)
    EXPECT_LT(norm(stations[k].pose.position - expected_stations[k].pose.position), 0.02) << k;
}

TEST_P(MotionPortProperties, RefinesToTheSameState) {
  const auto finer = port().refined();
  if (!finer) GTEST_SKIP() << "nothing to refine";
  const std::vector<double> y = port().adopt(
      still_.members[0].port->sections(
          Eigen::Vector3d::Zero(), std::vector<double>(still_.members[0].port->internal_size())),
      std::vector<double>(still_.members[0].port->internal_size(), 0.0));
  std::vector<double> fine(finer->internal_size());
  port().prolong(y, fine);
  MemberWork work = sized_work(*finer);
  const MotionPort::Answer a =
      port().evaluate(Eigen::Vector3d::Zero(), y.data(), y.data(), y.data(), work_);
  const MotionPort::Answer b =
      finer->evaluate(Eigen::Vector3d::Zero(), fine.data(), fine.data(), fine.data(), work);
  EXPECT_LT((a.tip - b.tip).norm(), 1e-9);
}

}  // namespace
}  // namespace flexura::testing

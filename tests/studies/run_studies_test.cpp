// Studies of a model run side by side: results do not depend on threads, nor a modeling's results
// on the others; progress and cancelling.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <set>
#include <string>

#include "flexura/studies/run_studies.hpp"
#include "tests/support/mechanism.hpp"
#include "tests/support/modelings.hpp"

namespace flexura::testing {
namespace {

Model chain_with_studies() {
  const Mechanism chain = arc_chain();
  Model model = chain.model();
  PathStudy push;
  push.loads = {chain.load("link4.E", {5e-4, 0.0})};
  push.steps = 6;
  push.modelings = {linear(), scmbm_centre(), scmbm_end(), prbm(), exact(1e-8), beam(12, 2)};
  push.reference = 4;
  LinearStudy ellipses;
  ellipses.loads = push.loads;
  InverseStudy back;
  for (std::size_t k = 0; k < 3; ++k)
    back.relative.push_back({k, {-0.3, 0.2}, 0.3, RelativeDisplacement::At::end});
  back.steps = 3;
  back.modelings = push.modelings;
  back.reference = 4;
  model.studies = {{"push", push, {}}, {"ellipses", ellipses, {}}, {"back", back, {}}};
  return model;
}

void expect_equal(const ModelingPath& a, const ModelingPath& b) {
  EXPECT_EQ(a.label, b.label);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.error_estimate, b.error_estimate);
  EXPECT_EQ(a.difference, b.difference);
  ASSERT_EQ(a.states.size(), b.states.size());
  for (std::size_t k = 0; k < a.states.size(); ++k) {
    EXPECT_EQ(a.states[k].bodies, b.states[k].bodies);
    EXPECT_EQ(a.states[k].points, b.states[k].points);
    EXPECT_EQ(a.states[k].strain_energy, b.states[k].strain_energy);
    ASSERT_EQ(a.states[k].reactions.size(), b.states[k].reactions.size());
    for (std::size_t r = 0; r < a.states[k].reactions.size(); ++r)
      EXPECT_EQ(a.states[k].reactions[r].force, b.states[k].reactions[r].force);
  }
}

RunOptions with_threads(int threads) {
  RunOptions options;
  options.threads = threads;
  return options;
}

TEST(RunStudies, ResultsDoNotDependOnTheNumberOfThreads) {
  const Model model = chain_with_studies();
  const Result one = run_studies(model, with_threads(1));
  const Result two = run_studies(model, with_threads(2));
  ASSERT_EQ(one.studies.size(), 3U);
  ASSERT_EQ(two.studies.size(), 3U);
  for (std::size_t s = 0; s < 3; ++s) {
    EXPECT_TRUE(one.studies[s].termination.converged()) << one.studies[s].termination.reason;
    EXPECT_EQ(one.studies[s].name, model.studies[s].name);
    const auto* a = std::get_if<PathResult>(&one.studies[s].content);
    if (a == nullptr) continue;
    const auto& b = std::get<PathResult>(two.studies[s].content);
    ASSERT_EQ(a->modelings.size(), 6U);
    for (std::size_t m = 0; m < 6; ++m) expect_equal(a->modelings[m], b.modelings[m]);
  }
}

TEST(RunStudies, RunsWhatIsAskedForOnly) {
  RunOptions options = with_threads(2);
  options.studies = {"push"};
  options.modelings = {"scmbm", "beam"};
  const Result result = run_studies(chain_with_studies(), options);
  ASSERT_EQ(result.studies.size(), 1U);
  const auto& path = std::get<PathResult>(result.studies[0].content);
  // by label or by modeling name: scmbm_end is a scmbm
  ASSERT_EQ(path.modelings.size(), 3U);
  EXPECT_EQ(path.modelings[0].label, "scmbm");
  EXPECT_EQ(path.modelings[1].label, "scmbm_end");
  EXPECT_EQ(path.modelings[2].label, "beam");
  // the study's reference is left out: the last one stands in
  EXPECT_EQ(path.reference, 2U);
  EXPECT_FALSE(path.modelings[2].difference.has_value());
}

/// The known order of accuracy on this chain: exact and a fine mesh agree, SCMBM at the centre is
/// better than at the end, linear is worst.
TEST(RunStudies, DifferencesRankTheModelings) {
  RunOptions options = with_threads(2);
  options.studies = {"push"};
  const Result result = run_studies(chain_with_studies(), options);
  const auto& m = std::get<PathResult>(result.studies[0].content).modelings;
  EXPECT_GT(m[0].difference.value(), m[2].difference.value());
  EXPECT_GT(m[2].difference.value(), m[1].difference.value());
  EXPECT_LT(m[5].difference.value(), 2e-4);
  EXPECT_LT(m[4].error_estimate.value(), 1e-8);
  EXPECT_FALSE(m[1].error_estimate.has_value());
  // what beams estimate of their own error is what they differ by from exact
  EXPECT_NEAR(m[5].error_estimate.value(), m[5].difference.value(), 0.2 * m[5].difference.value());
}

TEST(RunStudies, ReportsProgressOneCallAtATimeAndStopsWhenAsked) {
  std::atomic<int> inside = 0, overlaps = 0;
  std::set<std::string> labels;
  RunOptions options = with_threads(2);
  options.studies = {"push"};
  options.progress = [&](const ProgressReport& report) {
    if (++inside > 1) ++overlaps;
    labels.insert(std::string(report.label));
    EXPECT_GE(report.fraction, 0.0);
    EXPECT_LE(report.fraction, 1.0);
    --inside;
    return true;
  };
  run_studies(chain_with_studies(), options);
  EXPECT_EQ(overlaps, 0);
  EXPECT_EQ(labels.size(), 6U);

  options.progress = [](const ProgressReport&) { return false; };
  const Result stopped = run_studies(chain_with_studies(), options);
  EXPECT_EQ(stopped.studies[0].termination.status, Status::stopped);
  for (const ModelingPath& path : std::get<PathResult>(stopped.studies[0].content).modelings)
    EXPECT_EQ(path.states.size(), 2U) << path.label;  // at rest, and the first step
}

}  // namespace
}  // namespace flexura::testing

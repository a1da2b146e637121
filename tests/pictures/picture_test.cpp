#include "flexura/pictures/picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/pictures/picture_checks.hpp"
#include "tests/report/sample_motion.hpp"
#include "tests/report/sample_result.hpp"
#include "tests/report/sample_turn.hpp"

namespace flexura {
namespace {

using pictures::count_of;
using pictures::picture_faults;

std::string drawn(const Result& result, const PictureRequest& request) {
  const Picture picture = make_picture(result, request);
  EXPECT_EQ(picture.error, "");
  EXPECT_EQ(picture_faults(picture.svg), std::vector<std::string>{}) << request.study;
  EXPECT_LT(picture.svg.size(), 150000U) << request.study;
  return picture.svg;
}

std::string refused(const Result& result, const PictureRequest& request) {
  const Picture picture = make_picture(result, request);
  EXPECT_FALSE(picture.ok());
  EXPECT_TRUE(picture.svg.empty());
  return picture.error;
}

/// The number of values of the first animation.
std::size_t values_of(const std::string& svg) {
  const std::size_t from = svg.find("values=\"");
  return from == std::string::npos
             ? 0
             : count_of(svg.substr(from, svg.find("\"/>", from) - from), ";") + 1;
}

class EveryStudy : public ::testing::TestWithParam<Result (*)()> {};

TEST_P(EveryStudy, IsDrawnByEveryModelingMovingAndStill) {
  const Result result = GetParam()();
  for (const StudyResult& study : result.studies) {
    if (!can_be_drawn(study.kind)) {
      EXPECT_NE(refused(result, {study.name}).find("of kind " + study.kind), std::string::npos);
      continue;
    }
    std::vector<std::string> labels = {""};
    std::visit(
        [&](const auto& content) {
          if constexpr (requires { content.modelings; })
            for (const auto& modeling : content.modelings) labels.push_back(modeling.label);
        },
        study.content);
    for (const std::string& label : labels) {
      const std::string moving = drawn(result, {study.name, label});
      const std::string still = drawn(result, {study.name, label, 1, false});
      EXPECT_EQ(count_of(still, "<animate"), 0U);
      EXPECT_EQ(moving, drawn(result, {study.name, label})) << "not the same again";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, EveryStudy,
                         ::testing::Values(
                             +[] { return sample::make_sample_result(); },
                             +[] { return sample::make_sample_motion(); },
                             +[] { return sample::make_sample_turn(); }));

const StudyResult& study_of_kind(const Result& result, const std::string& kind) {
  return *std::ranges::find(result.studies, kind, &StudyResult::kind);
}

TEST(Pictures, OfPathsGoToAndFro) {
  const Result result = sample::make_sample_result();
  const std::string svg = drawn(result, {study_of_kind(result, "path").name});
  EXPECT_EQ(values_of(svg), 33U);
  EXPECT_GT(count_of(svg, "class=\"ground-line\""), 0U);
  EXPECT_GT(count_of(svg, "class=\"load\""), 0U);
  EXPECT_GT(count_of(svg, "class=\"way\""), 0U);
  EXPECT_GT(count_of(svg, "class=\"ghost\""), 0U);
}

TEST(Pictures, OfTransientsEndWhereTheyEnd) {
  const Result result = sample::make_sample_motion();
  EXPECT_EQ(values_of(drawn(result, {study_of_kind(result, "transient").name})), 91U);
}

TEST(Pictures, OfLoadsGrowAndShrinkByTheirHistories) {
  Result result = sample::make_sample_motion();
  StudyResult& study = result.studies[1];
  std::get<MotionResult>(study.content).held.clear();  // whose arrows look the same
  const auto with = [&](std::vector<double> factors) {
    study.loads[0].history = {"a history", 1.0, std::move(factors)};
    return drawn(result, {study.name});
  };
  EXPECT_EQ(count_of(with({0.0, 0.0}), "class=\"load\""), 0U);
  EXPECT_GT(count_of(with({0.0, 1.0}), "class=\"load\""), 0U);
  EXPECT_EQ(with({0.0, 1.0}), with({0.0, 2.0})) << "as long as can be where they are largest";
  EXPECT_NE(with({0.0, 1.0}), with({1.0, 0.0}));
}

TEST(Pictures, OfTurnsGoOnceRoundWithTheirDeflectionsExaggerated) {
  const Result result = sample::make_sample_turn();
  const std::string svg = drawn(result, {"turn"});
  EXPECT_EQ(values_of(svg), 49U);
  EXPECT_EQ(count_of(svg, "deflections ×"), 1U);
  EXPECT_GT(count_of(svg, "class=\"slider\""), 0U);
  EXPECT_GT(count_of(svg, "class=\"pin\""), 0U);
  PictureRequest plain{"turn"};
  plain.exaggeration = 1.0;
  EXPECT_EQ(count_of(drawn(result, plain), "deflections ×"), 0U);
}

TEST(Pictures, SayWhichModeTheyShow) {
  const Result result = sample::make_sample_motion();
  const StudyResult& study = study_of_kind(result, "modes");
  EXPECT_EQ(count_of(drawn(result, {study.name, "", 2}), "mode 2"), 1U);
  EXPECT_NE(refused(result, {study.name, "", 400}).find("has no mode 400"), std::string::npos);
}

TEST(Pictures, RefuseNamesThatTheResultDoesNotHave) {
  const Result result = sample::make_sample_turn();
  EXPECT_EQ(refused(result, {"trun"}), "the result has no study 'trun'");
  EXPECT_EQ(refused(result, {"turn", "perodic"}),
            "study 'turn' has no modeling 'perodic'; did you mean 'periodic'?");
}

/// A leaf that bends by its tip, 5 of its 100 lengths wide.
Result bent_leaf(double way) {
  Result result;
  result.length_unit = "mm";
  result.drawing.flexures.push_back(
      {"leaf", "ground", "tip", false, false, {{0, 0}, {25, 0}, {50, 0}, {75, 0}, {100, 0}}, 5});
  result.drawing.bodies.push_back({"ground", true, {0, 0}, {{0, 0}}, {}, {}});
  result.drawing.bodies.push_back({"tip", false, {100, 0}, {{100, 0}}, {"P"}, {{100, 0}}});
  PathResult path;
  path.bodies = {"tip"};
  path.points = {"tip.P"};
  path.flexures = {"leaf"};
  ModelingPath modeling;
  modeling.label = modeling.modeling = "exact";
  for (const double share : {0.0, 1.0}) {
    PathState state;
    state.load_factor = share;
    state.bodies = {{{100, share * way}, 0.0}};
    state.points = {{100, share * way}};
    state.axes = {{}};
    for (const double s : {0.0, 0.25, 0.5, 0.75, 1.0})
      state.axes[0].push_back({100 * s, share * way * s * s});
    modeling.states.push_back(state);
  }
  path.modelings = {modeling};
  result.studies.push_back({"bend", "path", {Status::converged, ""}, {}, {}, path});
  return result;
}

TEST(Pictures, ExaggerateWhatCannotBeSeen) {
  EXPECT_EQ(count_of(drawn(bent_leaf(20), {"bend"}), "displacements"), 0U);
  EXPECT_EQ(count_of(drawn(bent_leaf(0.01), {"bend"}), "displacements ×500"), 1U);
  EXPECT_EQ(count_of(drawn(bent_leaf(0.0), {"bend"}), "<animate"), 0U);
}

TEST(Pictures, ShowTrueOutlinesAndAScale) {
  const std::string svg = drawn(bent_leaf(20), {"bend", "", 1, false});
  EXPECT_EQ(count_of(svg, "class=\"solid\""), 4U);  // 5 of 100 mm are 31 pixels
  EXPECT_EQ(count_of(svg, ">20 mm</text>"), 1U);
}

TEST(Pictures, AreDrawnOfWhatConverged) {
  Result result = bent_leaf(20);
  auto& path = std::get<PathResult>(result.studies[0].content);
  path.modelings[0].states.pop_back();
  EXPECT_EQ(count_of(drawn(result, {"bend"}), "<animate"), 0U);
  path.modelings[0].states.clear();
  EXPECT_EQ(count_of(drawn(result, {"bend"}), "<animate"), 0U);
}

}  // namespace
}  // namespace flexura

// What the report embeds of modes, motions and responses, and how long motions are thinned.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "flexura/report/report_data.hpp"
#include "flexura/report/thinning.hpp"
#include "tests/report/sample_motion.hpp"

namespace flexura {
namespace {

nlohmann::json data_of(const Result& result) {
  return nlohmann::json::parse(make_report_data(result));
}

/// What the page makes of a series.
double value_at(const nlohmann::json& series, std::size_t i) {
  return series["start"].get<double>() +
         series["unit"].get<double>() * series["values"][i].get<double>();
}

TEST(Thinned, KeepsEverythingThatIsShort) {
  EXPECT_EQ(thinned(4, 4, 4), (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_EQ(thinned(1, 1, 1), (std::vector<std::size_t>{0}));
  EXPECT_TRUE(thinned(0, 100, 10).empty());
}

TEST(Thinned, KeepsEveryNthAndTheLast) {
  EXPECT_EQ(thinned(10, 10, 5), (std::vector<std::size_t>{0, 2, 4, 6, 8, 9}));
  // As the longest, so that the states of both are at the same times.
  EXPECT_EQ(thinned(5, 10, 5), (std::vector<std::size_t>{0, 2, 4}));
  for (const std::size_t count : {399U, 400U, 401U, 5000U, 12345U})
    EXPECT_LE(thinned(count, count, 400).size(), 401U) << count;
}

TEST(ReportData, HasJointsAndHistories) {
  const nlohmann::json data = data_of(sample::make_sample_motion());
  const nlohmann::json& joints = data["drawing"]["joints"];
  ASSERT_EQ(joints.size(), 2U);
  EXPECT_EQ(joints[0]["name"], "shaft");
  EXPECT_EQ(joints[0]["at"], nlohmann::json({0.0, 0.0}));
  EXPECT_TRUE(joints[0]["direction"].is_null());
  EXPECT_EQ(joints[1]["action"], "piston");
  EXPECT_EQ(joints[1]["direction"], nlohmann::json({1.0, 0.0}));
  const nlohmann::json& history = data["studies"][1]["loads"][0]["history"];
  EXPECT_EQ(history["words"], "a half-sine from 0.1 s that lasts 0.05 s");
  EXPECT_EQ(history["factors"], nlohmann::json({0.0, 0.5, 0.0}));
  EXPECT_EQ(history["largest"], 0.5);
  EXPECT_TRUE(data["studies"][0]["loads"][0]["history"].is_null());
}

TEST(ReportData, HasFrequenciesAlongAPath) {
  const Result result = sample::make_sample_motion();
  const auto& modes = std::get<ModeResult>(result.studies[0].content);
  const nlohmann::json exact = data_of(result)["studies"][0]["modes"]["modelings"][1];
  EXPECT_NEAR(exact["modes"][0]["value"], modes.modelings[1].modes[0].value, 1e-5);
  ASSERT_EQ(exact["curve"].size(), 11U);
  EXPECT_EQ(exact["curve"][2]["load_factor"], 0.2);
  EXPECT_NEAR(exact["curve"][2]["values"][1], modes.modelings[1].curve[2].angular_frequencies[1],
              1e-4);
}

TEST(ReportData, SeriesReadBackToSevenDigitsOfTheMotion) {
  Result result = sample::make_sample_motion();
  auto& motion = std::get<MotionResult>(result.studies[1].content);
  // A motion of a millionth, far from the origin, keeps its digits.
  for (MotionState& moment : motion.modelings[2].states)
    moment.state.bodies[1].position = {1e3 + 1e-3 * std::sin(moment.time), 5.0};
  const nlohmann::json exact = data_of(result)["studies"][1]["motion"]["modelings"][2];
  const nlohmann::json& fine = exact["fine"];
  ASSERT_EQ(fine["times"].size(), 201U);
  for (const std::size_t i : {0U, 77U, 200U}) {
    const MotionState& moment = motion.modelings[2].states[i];
    const double moved = moment.state.bodies[1].position.x - 1e3;
    EXPECT_NEAR(value_at(fine["bodies"][1][0], i) - 1e3, moved, 1e-10);
    EXPECT_NEAR(value_at(fine["bodies"][0][2], i), moment.state.bodies[0].rotation, 2e-6);
    EXPECT_NEAR(value_at(fine["points"][0][0], i), moment.state.points[0].x, 2e-6);
    EXPECT_NEAR(value_at(fine["energies"]["strain"], i), moment.energy.strain, 2e-5);
    EXPECT_NEAR(value_at(fine["energies"]["total"], i),
                moment.energy.kinetic + moment.energy.strain - moment.energy.work, 1e-5);
    EXPECT_NEAR(value_at(fine["reactions"][0][2], i), moment.state.reactions[0].moment, 2e-6);
    EXPECT_NEAR(value_at(exact["coarse"]["mids"][1][1], i), moment.state.mids[1].position.y, 2e-5);
    EXPECT_NEAR(value_at(exact["coarse"]["peaks"][1], i), moment.state.peak_stresses[1], 1e-5);
  }
  EXPECT_EQ(value_at(fine["bodies"][1][1], 10), 5.0);
}

TEST(ReportData, SeriesSayWhatIsNoNumber) {
  Result result = sample::make_sample_motion();
  auto& states = std::get<MotionResult>(result.studies[1].content).modelings[2].states;
  states[3].state.points[0].x = std::nan("");
  const nlohmann::json fine = data_of(result)["studies"][1]["motion"]["modelings"][2]["fine"];
  const nlohmann::json& x = fine["points"][0][0];
  EXPECT_TRUE(x["values"][3].is_null());
  EXPECT_NEAR(value_at(x, 4), states[4].state.points[0].x, 2e-6);
}

TEST(ReportData, LongMotionsAreThinned) {
  constexpr int outputs = 12'000;
  const Result result = sample::make_sample_motion(outputs);
  const std::string text = make_report_data(result);
  EXPECT_LT(text.size(), 5'000'000U);
  const nlohmann::json modelings = nlohmann::json::parse(text)["studies"][1]["motion"]["modelings"];
  for (const nlohmann::json& m : modelings) {
    const nlohmann::json& times = m["fine"]["times"];
    const nlohmann::json& coarse = m["coarse"]["at"];
    const nlohmann::json& frames = m["frames"]["at"];
    EXPECT_GT(times.size(), 2400U);
    EXPECT_LE(times.size(), 5001U);
    EXPECT_LE(coarse.size(), 1251U);
    EXPECT_LE(frames.size(), 401U);
    EXPECT_EQ(frames.back(), times.size() - 1);
    EXPECT_EQ(m["frames"]["axes"].size(), frames.size());
    EXPECT_EQ(m["coarse"]["mids"][0][0]["values"].size(), coarse.size());
    for (const nlohmann::json& at : frames)
      EXPECT_TRUE(std::ranges::binary_search(coarse, at)) << at;
  }
  // Both kept the same times as long as both went.
  EXPECT_EQ(modelings[1]["fine"]["times"][1000], modelings[2]["fine"]["times"][1000]);
}

TEST(ReportData, AxesOfMotionsHaveFewPoints) {
  const nlohmann::json motion = data_of(sample::make_sample_motion())["studies"][1]["motion"];
  const auto points = [&](std::size_t m) -> std::size_t {
    return motion["modelings"][m]["frames"]["axes"][7][0].size() / 2;
  };
  EXPECT_EQ(points(0), 5U);   // a chain keeps its joints
  EXPECT_EQ(points(2), 21U);  // of 41
}

TEST(ReportData, KnowsHowAMotionIsStressed) {
  const nlohmann::json exact =
      data_of(sample::make_sample_motion())["studies"][1]["motion"]["modelings"][2];
  EXPECT_EQ(exact["largest_stress"]["flexure"], 1);
  EXPECT_GT(exact["largest_stress"]["value"], 50.0);
  EXPECT_LT(exact["safety"]["reached"]["load_factor"], exact["largest_stress"]["time"]);
}

TEST(ReportData, HasResponsesOverTheFrequency) {
  const Result result = sample::make_sample_motion();
  const auto& response = std::get<ResponseResult>(result.studies[2].content);
  const nlohmann::json data = data_of(result)["studies"][2]["response"];
  EXPECT_EQ(data["places"][2], (nlohmann::json{{"name", "crank.rotation"}, {"rotation", true}}));
  const nlohmann::json& exact = data["modelings"][1];
  const ResponseState& state = response.modelings[1].states[120];
  EXPECT_NEAR(exact["frequencies"][120], state.angular_frequency / (2.0 * std::numbers::pi), 1e-5);
  EXPECT_NEAR(exact["amplitudes"][9][120], std::abs(state.amplitudes[9]), 1e-6);
  EXPECT_NEAR(exact["phases"][9][120], std::arg(state.amplitudes[9]), 1e-6);
  ASSERT_EQ(exact["peaks"][9].size(), 2U);
  EXPECT_NEAR(exact["peaks"][9][0]["phase"], -std::numbers::pi / 2.0, 0.2);
  EXPECT_TRUE(exact["peaks"][4].empty());
}

TEST(ReportData, CopesWithMotionsThatNeverBegan) {
  Result result = sample::make_sample_motion();
  ModelingMotion& motion = std::get<MotionResult>(result.studies[1].content).modelings[0];
  motion = {};
  motion.label = "prbm";
  const nlohmann::json json = data_of(result)["studies"][1]["motion"]["modelings"][0];
  EXPECT_TRUE(json["fine"]["times"].empty());
  EXPECT_TRUE(json["frames"]["axes"].empty());
}

}  // namespace
}  // namespace flexura

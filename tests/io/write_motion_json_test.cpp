#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "flexura/io/write_json.hpp"
#include "flexura/results/extremes.hpp"
#include "tests/report/sample_motion.hpp"

namespace flexura {
namespace {

using Json = nlohmann::ordered_json;

Json studies_of(const Result& result) { return Json::parse(make_summary_json(result))["studies"]; }

TEST(SummaryJson, HasFrequenciesAndTheirCurve) {
  const Result result = sample::make_sample_motion();
  const auto& modes = std::get<ModeResult>(result.studies[0].content).modelings[1];
  const Json study = studies_of(result)["sing"];
  EXPECT_EQ(study["kind"], "modes");
  EXPECT_EQ(study["reference"], "exact");
  const Json& exact = study["modelings"]["exact"];
  EXPECT_FALSE(exact.contains("load_factors"));
  ASSERT_EQ(exact["angular_frequencies"].size(), 3U);
  EXPECT_EQ(exact["angular_frequencies"][0], modes.modes[0].value);
  EXPECT_LT(exact["angular_frequencies"][0], 0.0);
  ASSERT_EQ(exact["curve"].size(), 11U);
  EXPECT_EQ(exact["curve"][3]["load_factor"], modes.curve[3].load_factor);
  EXPECT_EQ(exact["curve"][3]["angular_frequencies"][2], modes.curve[3].angular_frequencies[2]);
}

TEST(SummaryJson, LeavesTheCurveOutWhereThereIsNone) {
  Result result = sample::make_sample_motion();
  std::get<ModeResult>(result.studies[0].content).modelings[1].curve.clear();
  EXPECT_FALSE(studies_of(result)["sing"]["modelings"]["exact"].contains("curve"));
  result.studies[0].kind = "buckling";
  const Json exact = studies_of(result)["sing"]["modelings"]["exact"];
  EXPECT_EQ(exact["load_factors"].size(), 3U);
  EXPECT_FALSE(exact.contains("angular_frequencies"));
}

TEST(SummaryJson, SaysWhatAMotionCost) {
  const Json study = studies_of(sample::make_sample_motion())["turn"];
  EXPECT_EQ(study["method"], "radau");
  EXPECT_EQ(study["damping"], "2 % of critical in every mode about the start");
  EXPECT_EQ(study["reference"], "exact");
  const Json& fine = study["modelings"]["fine"];
  EXPECT_EQ(fine["modeling"], "beam");
  EXPECT_EQ(fine["status"], "converged");
  EXPECT_EQ(fine["unknowns"], 198);
  EXPECT_EQ(fine["steps"], 640);
  EXPECT_EQ(fine["rejected"], 3);
  EXPECT_EQ(fine["iterations"], 1873);
  EXPECT_EQ(fine["seconds"], 1.72);
  EXPECT_EQ(fine["smallest_step"], 2.1e-4);
  EXPECT_EQ(fine["largest_step"], 3.4e-3);
  EXPECT_EQ(fine["energy_error"], 3.3e-8);
  EXPECT_EQ(fine["error_estimate"], 4.6e-6);
  EXPECT_GT(fine["difference"], 0.0);
  EXPECT_TRUE(study["modelings"]["exact"]["difference"].is_null());
  EXPECT_EQ(study["modelings"]["scmbm"]["status"], "stopped");
}

TEST(SummaryJson, SaysHowAMotionIsStressed) {
  Result result = sample::make_sample_motion();
  auto& motion = std::get<MotionResult>(result.studies[1].content);
  ModelingMotion& exact = motion.modelings[2];
  exact.states[70].state.peak_stresses[0] = 1e3;
  exact.states[40].state.peak_stresses[1] = 60.0;
  exact.states.back().state.peak_stresses[1] = 25.0;
  for (std::size_t k = 0; k < 40; ++k) exact.states[k].state.peak_stresses[1] = 10.0;
  const Json json = studies_of(result)["turn"]["modelings"]["exact"];
  EXPECT_EQ(json["largest_stress"],
            (Json{{"value", 1e3}, {"time", exact.states[70].time}, {"flexure", "rod"}}));
  EXPECT_EQ(json["safety"]["factor"], 2.0);
  EXPECT_EQ(json["safety"]["flexure"], "leaf");
  const Json& reached = json["safety"]["strength_reached"];
  EXPECT_EQ(reached["flexure"], "leaf");
  EXPECT_GT(reached["time"], exact.states[39].time);
  EXPECT_LT(reached["time"], exact.states[40].time);
  EXPECT_TRUE(reached["displacements"].contains("tip.P"));
  EXPECT_EQ(json["extremes"]["stress"]["value"],
            find_extreme(exact, &MemberStation::stress)->value);
}

TEST(SummaryJson, KeepsSilentOnStressesThatAMotionDoesNotKnow) {
  Result result = sample::make_sample_motion();
  ModelingMotion& exact = std::get<MotionResult>(result.studies[1].content).modelings[2];
  for (MotionState& moment : exact.states) moment.state.peak_stresses.clear();
  exact.members.clear();
  const Json json = studies_of(result)["turn"]["modelings"]["exact"];
  EXPECT_FALSE(json.contains("largest_stress"));
  EXPECT_FALSE(json.contains("safety"));
  EXPECT_TRUE(json["extremes"].empty());
}

TEST(SummaryJson, ListsThePeaksOfAResponse) {
  const Json study = studies_of(sample::make_sample_motion())["shake"];
  EXPECT_EQ(study["damping"], "2 % of critical in every mode");
  const Json& exact = study["modelings"]["exact"];
  EXPECT_EQ(exact["unknowns"], 9);
  EXPECT_EQ(exact["error_estimate"], 1.5e-6);
  EXPECT_TRUE(exact["difference"].is_null());
  std::vector<double> frequencies;
  for (const Json& peak : exact["peaks"]) {
    EXPECT_NE(peak["place"], "piston.y");
    if (peak["place"] == "tip.P.x") frequencies.push_back(peak["frequency"]);
    EXPECT_GT(peak["amplitude"], 0.0);
  }
  ASSERT_EQ(frequencies.size(), 2U);
  EXPECT_NEAR(frequencies[0], 17.0, 0.2);
  EXPECT_NEAR(frequencies[1], 41.3, 0.7);
}

TEST(SummaryJson, NeverHoldsWhatIsNoNumberOfAMotion) {
  Result result = sample::make_sample_motion();
  std::get<MotionResult>(result.studies[1].content).modelings[0].energy_error = std::nan("");
  EXPECT_TRUE(studies_of(result)["turn"]["modelings"]["prbm"]["energy_error"].is_null());
}

}  // namespace
}  // namespace flexura

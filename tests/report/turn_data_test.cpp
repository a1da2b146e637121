// What the report embeds of linkages.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "flexura/report/report_data.hpp"
#include "tests/report/sample_turn.hpp"

namespace flexura {
namespace {

constexpr int intervals = 36;

class TurnData : public testing::Test {
 protected:
  nlohmann::json linkage(std::size_t study) const {
    return nlohmann::json::parse(make_report_data(result_))["studies"][study]["linkage"];
  }
  const LinkageResult& record(std::size_t study) const {
    return std::get<LinkageResult>(result_.studies[study].content);
  }

  Result result_ = sample::make_sample_turn(intervals);
};

TEST_F(TurnData, HasEveryPosition) {
  const nlohmann::json data = linkage(0);
  ASSERT_EQ(data["positions"].size(), intervals + 1U);
  const RigidPosition& expected = record(0).positions[5];
  const nlohmann::json& position = data["positions"][5];
  EXPECT_NEAR(position["angle"], expected.angle, 1e-6);
  EXPECT_NEAR(position["rotations"][0], expected.bodies[0].rotation, 1e-6);
  ASSERT_EQ(position["bodies"].size(), 6U);
  EXPECT_NEAR(position["bodies"][2], expected.bodies[1].position.x, 1e-3);
  ASSERT_EQ(position["flexures"].size(), 2U);
  EXPECT_NEAR(position["flexures"][1][2], expected.flexures[1][1].x, 1e-3);
  EXPECT_NEAR(position["points"][1], expected.points[0].y, 1e-3);
  EXPECT_NEAR(position["torque"], expected.torque, 1e-5);
  EXPECT_NEAR(position["shaking_force"][0], expected.shaking_force.x, 1e-5);
  EXPECT_NEAR(position["transmission_angle"], *expected.transmission_angle, 1e-6);
  EXPECT_TRUE(linkage(1)["positions"][5]["transmission_angle"].is_null());
}

TEST_F(TurnData, DisplacementsBelongToTheDrawnAxes) {
  const nlohmann::json data = linkage(0);
  const LinkageMotion& expected = record(0).modelings[1];
  const nlohmann::json& method = data["methods"][1];
  ASSERT_EQ(method["displacements"].size(), intervals + 1U);
  for (std::size_t f = 0; f < 2; ++f)
    EXPECT_EQ(method["displacements"][7][f].size(), data["positions"][7]["flexures"][f].size());
  EXPECT_NEAR(method["displacements"][7][0][20], expected.displacements[7][0][10].x, 1e-6);
  EXPECT_NEAR(method["bodies"][7][5], expected.bodies[7][2].y, 1e-6);
  EXPECT_NEAR(method["points"][7][0], expected.points[7][0].x, 1e-6);
}

TEST_F(TurnData, PeaksKeepTheirSignAndSayWhere) {
  const nlohmann::json quasi_static = linkage(0)["methods"][0];
  // The rod's way out is -0.3 sin(angle): the first of two equal peaks, below zero.
  const nlohmann::json& peak = quasi_static["flexures"][0]["peaks"]["deflection"];
  EXPECT_NEAR(peak["value"], -0.3, 1e-6);
  EXPECT_NEAR(peak["angle"], 0.5 * std::numbers::pi, 1e-6);
  EXPECT_EQ(quasi_static["flexures"][0]["upper_stress"].size(), intervals + 1U);
  EXPECT_EQ(quasi_static["flexures"][0]["upper_stress"][3].size(),
            linkage(0)["stations"][0].size());
}

TEST_F(TurnData, SaysHowMethodsEnded) {
  const nlohmann::json data = linkage(0);
  EXPECT_EQ(data["reference"], 1);
  EXPECT_TRUE(data["methods"][0]["error_estimate"].is_null());
  EXPECT_EQ(data["methods"][2]["remark"], "The coupling terms are not small at this speed.");
  const nlohmann::json& stopped = data["methods"][3];
  EXPECT_FALSE(stopped["converged"]);
  EXPECT_EQ(stopped["reason"], "It did not settle within 400 turns; add damping.");
  EXPECT_TRUE(stopped["flexures"].empty());
  EXPECT_TRUE(stopped["displacements"].empty());
}

TEST_F(TurnData, HasStabilityOverSpeed) {
  const nlohmann::json data = linkage(0);
  EXPECT_EQ(data["multipliers"][1], nlohmann::json({0.2, -0.9}));
  ASSERT_EQ(data["speeds"].size(), 25U);
  EXPECT_FALSE(data["speeds"][0]["buckles"]);
  EXPECT_EQ(data["speeds"][3]["peak_strain"].size(), 2U);
  EXPECT_TRUE(data["speeds"][24]["buckles"]);
  EXPECT_TRUE(linkage(1)["speeds"].empty());
  EXPECT_TRUE(linkage(1)["buckling_factor"].is_null());
}

TEST_F(TurnData, OfWhatNeverRanThereAreNamesOnly) {
  const nlohmann::json data = linkage(2);
  EXPECT_TRUE(data["positions"].empty());
  EXPECT_TRUE(data["methods"].empty());
  EXPECT_EQ(data["flexures"], nlohmann::json({"rod", "leaf"}));
}

}  // namespace
}  // namespace flexura

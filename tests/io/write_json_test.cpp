#include "flexura/io/write_json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/report/sample_result.hpp"

namespace flexura {
namespace {

using Json = nlohmann::ordered_json;

TEST(SummaryJson, HasTheFieldsOfTheContract) {
  const Result result = sample::make_sample_result();
  const Json json = Json::parse(make_summary_json(result));
  EXPECT_EQ(json["title"], result.title);
  EXPECT_EQ(json["version"], "0.1.0");
  EXPECT_EQ(json["units"]["length"], "mm");
  const Json& exact = json["studies"]["push"]["modelings"]["exact"];
  EXPECT_EQ(exact["status"], "converged");
  EXPECT_EQ(exact["reason"], "");
  EXPECT_EQ(exact["unknowns"], 9);
  EXPECT_EQ(exact["steps"], 20);
  EXPECT_EQ(exact["iterations"], 80);
  EXPECT_EQ(exact["seconds"], 0.47e-3);
  EXPECT_EQ(exact["error_estimate"], 3.1e-10);
  EXPECT_EQ(exact["difference"],
            *std::get<PathResult>(result.studies[0].content).modelings[3].difference);
  EXPECT_TRUE(exact["events"].empty());
  EXPECT_EQ(json["studies"]["push"]["reference"], "continuum");
  EXPECT_TRUE(json["studies"]["push"]["modelings"]["continuum"]["difference"].is_null());
  EXPECT_TRUE(json["studies"]["push"]["modelings"]["linear"]["error_estimate"].is_null());
}

TEST(SummaryJson, SaysWhyAndWhere) {
  const Result result = sample::make_sample_result();
  const Json json = Json::parse(make_summary_json(result));
  const Json& scmbm = json["studies"]["lift & turn"]["modelings"]["scmbm"];
  EXPECT_EQ(scmbm["status"], "stopped");
  EXPECT_EQ(scmbm["reason"].get<std::string>().find("No equilibrium was found"), 0U);
  const Json& event = scmbm["events"][0];
  EXPECT_EQ(event["kind"], "stability lost");
  EXPECT_EQ(event["load_factor"], 0.57);
  const PathState& state =
      std::get<PathResult>(result.studies[1].content).modelings[1].events[0].state;
  EXPECT_EQ(event["state"]["points"]["link4.E"]["x"], state.points[0].x);
  EXPECT_EQ(event["state"]["bodies"]["link4"]["rotation"], state.bodies[2].rotation);
}

TEST(SummaryJson, KeepsTheOrderOfTheFile) {
  const Json json = Json::parse(make_summary_json(sample::make_sample_result()));
  std::vector<std::string> labels;
  for (const auto& item : json["studies"]["push"]["modelings"].items())
    labels.push_back(item.key());
  EXPECT_EQ(labels, (std::vector<std::string>{"linear", "scmbm", "prbm", "exact", "continuum"}));
}

TEST(SummaryJson, SaysWhereTheLastStateIsLoadedMost) {
  Result result = sample::make_sample_result();
  auto& path = std::get<PathResult>(result.studies[0].content);
  path.modelings[0].members = {{{0.0, {}, 1.0, 2.0, -3.0, 4.0}, {5.0, {}, -6.0, 2.5, 1.0, 3.0}},
                               {{7.0, {}, 0.0, -2.0, 2.0, 9.0}}};
  path.modelings[1].members.clear();
  const Json all = Json::parse(make_summary_json(result))["studies"]["push"]["modelings"];
  const Json& extremes = all[path.modelings[0].label]["extremes"];
  EXPECT_EQ(extremes["axial_force"],
            (Json{{"value", -6.0}, {"flexure", path.flexures[0]}, {"s", 5.0}}));
  EXPECT_EQ(extremes["shear_force"]["value"], 2.5);
  EXPECT_EQ(extremes["bending_moment"]["value"], -3.0);
  EXPECT_EQ(extremes["bending_moment"]["s"], 0.0);
  EXPECT_EQ(extremes["stress"]["flexure"], path.flexures[1]);
  EXPECT_TRUE(all[path.modelings[1].label]["extremes"].empty());
}

TEST(SummaryJson, HasSafetyWhereAStrengthIsStated) {
  Result result = sample::make_sample_result();
  auto& path = std::get<PathResult>(result.studies[0].content);
  const auto safety = [&] {
    return Json::parse(
        make_summary_json(result))["studies"]["push"]["modelings"]["exact"]["safety"];
  };
  EXPECT_TRUE(safety().is_null());
  path.strengths = {50.0, 50.0, {}};
  for (ModelingPath& modeling : path.modelings)
    for (PathState& state : modeling.states) state.peak_stresses = {0.0, 0.0, 1e3};
  EXPECT_EQ(safety(), (Json{{"factor", nullptr}, {"flexure", nullptr}, {"strength_reached", {}}}));
  ModelingPath& exact = path.modelings[3];
  for (PathState& state : exact.states) state.peak_stresses[1] = 80.0 * state.load_factor;
  const Json found = safety();
  EXPECT_EQ(found["factor"], 0.625);
  EXPECT_EQ(found["flexure"], path.flexures[1]);
  const Json& reached = found["strength_reached"];
  EXPECT_NEAR(reached["load_factor"], 0.625, 1e-12);
  EXPECT_EQ(reached["flexure"], path.flexures[1]);
  const double least = exact.states[12].points[0].x - exact.states[0].points[0].x;
  const double most = exact.states[13].points[0].x - exact.states[0].points[0].x;
  const double x = reached["displacements"]["link4.E"]["x"];
  EXPECT_NEAR(x, 0.5 * (least + most), 0.05 * std::abs(most - least));
}

TEST(SummaryJson, CountsWhatNeverRanAsStopped) {
  Result result = sample::make_sample_result();
  result.studies[0].termination = {};
  const Json study = Json::parse(make_summary_json(result))["studies"]["push"];
  EXPECT_EQ(study["status"], "stopped");
  EXPECT_EQ(study["reason"], "not run");
}

TEST(SummaryJson, NeverHoldsWhatIsNoNumber) {
  Result result = sample::make_sample_result();
  std::get<PathResult>(result.studies[0].content).modelings[0].difference = std::nan("");
  const Json json = Json::parse(make_summary_json(result));
  EXPECT_TRUE(json["studies"]["push"]["modelings"]["linear"]["difference"].is_null());
}

TEST(EllipseJson, HoldsEveryRecordByItsName) {
  const Result result = sample::make_sample_result();
  const StudyResult& study = result.studies[3];
  const auto& linear = std::get<LinearResult>(study.content);
  const Json json = Json::parse(make_ellipse_json(result, study, linear));
  EXPECT_EQ(json["flexures"].size(), 3U);
  EXPECT_EQ(json["bodies"].size(), 3U);
  const ElasticityRecord& record = linear.records.back();
  const Json& point = json["points"]["link4.E"];
  EXPECT_EQ(point["at"], Json::array({record.at.x, record.at.y}));
  EXPECT_EQ(point["compliance"].get<ComplianceMatrix>(), record.compliance);
  EXPECT_EQ(point["elastic_weight"], record.ellipse->weight);
  EXPECT_EQ(point["semi_axes"], Json::array({record.ellipse->major, record.ellipse->minor}));
  EXPECT_EQ(point["orientation"], record.ellipse->orientation);
  EXPECT_EQ(point["principal_compliances"][0], record.principal_compliances[0]);
  EXPECT_EQ(point["principal_directions"][1][0], record.principal_directions[1].x);
  EXPECT_EQ(json["poles"][0]["pole"],
            Json::array({linear.poles[0].pole->x, linear.poles[0].pole->y}));
  EXPECT_EQ(json["order"]["load"][2], "moment");
}

TEST(EllipseJson, SaysNullWhereThereIsNoEllipse) {
  const Result result = sample::make_sample_result();
  LinearResult linear;
  linear.records.resize(1);
  linear.records[0].name = "bar";
  linear.poles.resize(1);
  const Json json = Json::parse(make_ellipse_json(result, result.studies[3], linear));
  const Json& bar = json["flexures"]["bar"];
  EXPECT_EQ(bar["elastic_weight"], 0.0);
  for (const char* absent : {"centre", "semi_axes", "orientation", "antipolar"}) {
    EXPECT_TRUE(bar[absent].is_null()) << absent;
  }
  EXPECT_TRUE(json["poles"][0]["pole"].is_null());
}

}  // namespace
}  // namespace flexura

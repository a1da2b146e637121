#include "flexura/io/write_motion_csv.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace flexura {
namespace {

using Words = std::vector<std::string>;
constexpr double full_turn = 2.0 * std::numbers::pi;

std::vector<Words> rows_of(const std::string& text) {
  std::vector<Words> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back(1);
    for (const char c : line)
      if (c == ',') {
        rows.back().emplace_back();
      } else {
        rows.back().back() += c;
      }
  }
  return rows;
}

double number(const std::string& word) { return std::strtod(word.c_str(), nullptr); }

MotionResult make_motion() {
  MotionResult motion;
  motion.bodies = {"a", "b"};
  motion.points = {"b.Q", "a.P"};
  motion.flexures = {"leaf"};
  motion.held = {{"a", 0, {}}};
  ModelingMotion modeling;
  for (int k = 0; k < 2; ++k) {
    MotionState moment;
    moment.time = 0.1 * k;
    moment.state.load_factor = 17.0;
    moment.state.bodies = {{{1, 2}, 0.5 * k}, {{3, 4}, 0}};
    moment.state.points = {{5, 6}, {7, 8}};
    moment.state.mids = {{{11, 12}, 13}};
    if (k > 0) moment.state.reactions = {{{21, 22}, 23}};
    moment.energy = {1.0 / 3.0, 2, 3, 4, 5e-9, {6, 7}, 8, 9e-13};
    modeling.states.push_back(moment);
  }
  motion.modelings = {modeling};
  return motion;
}

TEST(ModesCsv, HasAngularAndOrdinaryFrequencies) {
  ModelingModes modes;
  for (const double value : {-3.5, 0.0, 2.0 / 3.0}) modes.modes.push_back({value, {}, {}, {}});
  const auto rows = rows_of(make_modes_csv(modes).text);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0], (Words{"mode", "angular_frequency", "frequency"}));
  EXPECT_EQ(rows[1][1], "-3.5");
  EXPECT_EQ(rows[2], (Words{"2", "0", "0"}));
  EXPECT_EQ(number(rows[3][1]), 2.0 / 3.0);
  EXPECT_EQ(number(rows[3][2]), 2.0 / 3.0 / full_turn);
}

TEST(FrequenciesCsv, LeavesWhatIsNotKnownEmpty) {
  ModelingModes modes;
  modes.curve = {{0.0, {1.5, 2.5}}, {0.5, {-1.0}}, {1.0, {}}};
  const auto rows = rows_of(make_frequencies_csv(modes).text);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0], (Words{"load_factor", "w1", "w2"}));
  EXPECT_EQ(rows[1], (Words{"0", "1.5", "2.5"}));
  EXPECT_EQ(rows[2], (Words{"0.5", "-1", ""}));
  EXPECT_EQ(rows[3], (Words{"1", "", ""}));
}

TEST(MotionCsv, HasTheColumnsOfAPathBehindTheTime) {
  const MotionResult motion = make_motion();
  const auto rows = rows_of(make_motion_csv(motion, motion.modelings[0]).text);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0],
            (Words{"time", "a.x", "a.y", "a.rotation", "a.P.x", "a.P.y", "b.x", "b.y", "b.rotation",
                   "b.Q.x", "b.Q.y", "leaf.mid.x", "leaf.mid.y", "leaf.mid.rotation",
                   "a.reaction.x", "a.reaction.y", "a.reaction.moment"}));
  EXPECT_EQ(rows[1], (Words{"0", "1", "2", "0", "7", "8", "3", "4", "0", "5", "6", "11", "12", "13",
                            "0", "0", "0"}));
  EXPECT_EQ(rows[2], (Words{"0.1", "1", "2", "0.5", "7", "8", "3", "4", "0", "5", "6", "11", "12",
                            "13", "21", "22", "23"}));
}

TEST(EnergyCsv, HasTheBalanceOfEveryState) {
  const MotionResult motion = make_motion();
  const auto rows = rows_of(make_energy_csv(motion.modelings[0]).text);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0],
            (Words{"time", "kinetic_energy", "strain_energy", "work", "dissipated", "energy_error",
                   "momentum_x", "momentum_y", "angular_momentum", "constraint_drift"}));
  EXPECT_EQ(number(rows[2][1]), 1.0 / 3.0);
  EXPECT_EQ(Words(rows[2].begin() + 2, rows[2].end()),
            (Words{"2", "3", "4", "5e-09", "6", "7", "8", "9e-13"}));
}

TEST(ResponseCsv, HasAmplitudeAndPhaseOfEveryPlace) {
  ResponseResult response;
  response.places = {"a.x", "a.P.y"};
  ModelingResponse modeling;
  modeling.states = {{3.0, {{3.0, -4.0}, {-2.0, -0.0}}}};
  const auto rows = rows_of(make_response_csv(response, modeling).text);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0], (Words{"angular_frequency", "frequency", "a.x.amplitude", "a.x.phase",
                            "a.P.y.amplitude", "a.P.y.phase"}));
  EXPECT_EQ(number(rows[1][1]), 3.0 / full_turn);
  EXPECT_EQ(rows[1][2], "5");
  EXPECT_EQ(number(rows[1][3]), std::atan2(-4.0, 3.0));
  EXPECT_EQ(rows[1][4], "2");
  EXPECT_EQ(number(rows[1][5]), std::numbers::pi);
}

TEST(MotionFiles, RefuseWhatIsNoNumber) {
  const double bad = std::numeric_limits<double>::infinity();
  MotionResult motion = make_motion();
  motion.modelings[0].states[1].state.reactions[0].moment = bad;
  motion.modelings[0].states[0].energy.drift = std::nan("");
  EXPECT_EQ(make_motion_csv(motion, motion.modelings[0]).error,
            "row 1: a.reaction.moment is not a finite number");
  const CsvText energy = make_energy_csv(motion.modelings[0]);
  EXPECT_EQ(energy.error, "row 0: constraint_drift is not a finite number");
  EXPECT_TRUE(energy.text.empty());
  ModelingModes modes;
  modes.modes = {{bad, {}, {}, {}}};
  modes.curve = {{1.0, {2.0, bad}}};
  EXPECT_EQ(make_modes_csv(modes).error, "row 0: angular_frequency is not a finite number");
  EXPECT_EQ(make_frequencies_csv(modes).error, "row 0: w2 is not a finite number");
  ResponseResult response;
  response.places = {"a.x"};
  ModelingResponse modeling;
  modeling.states = {{1.0, {{bad, 0.0}}}};
  EXPECT_EQ(make_response_csv(response, modeling).error,
            "row 0: a.x.amplitude is not a finite number");
}

}  // namespace
}  // namespace flexura

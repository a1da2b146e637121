#include "flexura/io/write_csv.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace flexura {
namespace {

using Rows = std::vector<std::vector<std::string>>;

Rows rows_of(const std::string& text) {
  Rows rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

/// Two bodies, three points given out of the bodies' order, one flexure, two states.
PathResult make_path() {
  PathResult path;
  path.bodies = {"a", "b"};
  path.points = {"b.Q", "a.P", "b.R"};
  path.flexures = {"leaf"};
  ModelingPath modeling;
  modeling.label = "exact";
  for (int k = 0; k < 2; ++k) {
    const double d = 0.1 * k;
    PathState state;
    state.load_factor = k;
    state.bodies = {{{1 + d, 2}, d}, {{3, 4 - d}, -d}};
    state.points = {{5, 6}, {7, 8}, {9, 10}};
    state.mids = {{{11, 12}, d / 3.0}};
    modeling.states.push_back(state);
  }
  path.modelings = {modeling};
  return path;
}

TEST(PathCsv, HasTheColumnsOfTheContract) {
  const PathResult path = make_path();
  const Rows rows = rows_of(make_path_csv(path, path.modelings[0]).text);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"step", "load_factor", "a.x", "a.y", "a.rotation",
                                               "a.P.x", "a.P.y", "b.x", "b.y", "b.rotation",
                                               "b.Q.x", "b.Q.y", "b.R.x", "b.R.y", "leaf.mid.x",
                                               "leaf.mid.y", "leaf.mid.rotation"}));
  EXPECT_EQ(rows[1], (std::vector<std::string>{"0", "0", "1", "2", "0", "7", "8", "3", "4", "0",
                                               "5", "6", "9", "10", "11", "12", "0"}));
}

TEST(PathCsv, AddsReactionsWhereThereAreSome) {
  PathResult path = make_path();
  path.held = {{"a", 0, {}}, {"b", 1, {}}};
  path.modelings[0].states[1].reactions = {{{1, 2}, 3}, {{4, 5}, 6}};
  const Rows rows = rows_of(make_path_csv(path, path.modelings[0]).text);
  const std::vector<std::string> last(rows[0].end() - 6, rows[0].end());
  EXPECT_EQ(last, (std::vector<std::string>{"a.reaction.x", "a.reaction.y", "a.reaction.moment",
                                            "b.reaction.x", "b.reaction.y", "b.reaction.moment"}));
  for (const auto& row : rows) EXPECT_EQ(row.size(), rows[0].size());
  EXPECT_EQ(rows[1].back(), "0");
  EXPECT_EQ(rows[2].back(), "6");
}

TEST(PathCsv, NumbersReadBackToTheSameDouble) {
  PathResult path = make_path();
  const std::vector<double> values{
      0.1, 1.0 / 3.0, 6.02214076e23, 5e-324, -1.7976931348623157e308, std::nextafter(1.0, 2.0)};
  for (const double value : values) {
    path.modelings[0].states[1].bodies[0].rotation = value;
    const Rows rows = rows_of(make_path_csv(path, path.modelings[0]).text);
    EXPECT_EQ(std::strtod(rows[2][4].c_str(), nullptr), value);
  }
}

TEST(PathCsv, WritesNegativeZeroAsZero) {
  PathResult path = make_path();
  path.modelings[0].states[0].bodies[0].rotation = -0.0;
  EXPECT_EQ(rows_of(make_path_csv(path, path.modelings[0]).text)[1][4], "0");
}

TEST(PathCsv, RefusesWhatIsNoNumber) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    PathResult path = make_path();
    path.modelings[0].states[1].points[2].y = bad;
    const CsvText csv = make_path_csv(path, path.modelings[0]);
    EXPECT_EQ(csv.error, "row 1: b.R.y is not a finite number");
    EXPECT_TRUE(csv.text.empty());
  }
}

TEST(PathCsv, QuotesNamesThatHoldSeparators) {
  PathResult path = make_path();
  path.flexures = {"leaf, \"long\""};
  const std::string text = make_path_csv(path, path.modelings[0]).text;
  EXPECT_NE(text.find(",\"leaf, \"\"long\"\".mid.x\","), std::string::npos) << text;
}

TEST(PathCsv, GivesAPointToTheLongestBodyName) {
  PathResult path = make_path();
  path.bodies = {"b", "b.Q"};
  path.points = {"b.P", "b.Q.x1", "b.R"};
  const Rows rows = rows_of(make_path_csv(path, path.modelings[0]).text);
  EXPECT_EQ(rows[0][5], "b.P.x");
  EXPECT_EQ(rows[0][9], "b.Q.x");
  EXPECT_EQ(rows[0][12], "b.Q.x1.x");
}

TEST(MembersCsv, HasARowPerStation) {
  PathResult path = make_path();
  path.modelings[0].members = {
      {{0.5, {{1, 2}, 0.25}, 3, 4, 5, 6}, {0.75, {{1, 2}, 0.25}, 3, 4, 5, 6}}};
  const Rows rows = rows_of(make_members_csv(path.flexures, path.modelings[0].members).text);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"flexure", "s", "x", "y", "rotation", "axial_force",
                                               "shear_force", "bending_moment", "stress"}));
  EXPECT_EQ(rows[1],
            (std::vector<std::string>{"leaf", "0.5", "1", "2", "0.25", "3", "4", "5", "6"}));
}

}  // namespace
}  // namespace flexura

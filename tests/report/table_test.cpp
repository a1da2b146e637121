#include "flexura/report/table.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "flexura/report/wrap.hpp"
#include "tests/report/sample_motion.hpp"
#include "tests/report/sample_result.hpp"

namespace flexura {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

Result only(std::size_t study) {
  Result result = sample::make_sample_result();
  result.studies = {result.studies[study]};
  return result;
}

TEST(ComparisonTable, HasARowPerModeling) {
  const std::vector<std::string> lines = lines_of(make_comparison_table(only(0), false));
  ASSERT_EQ(lines.size(), 7U);
  EXPECT_EQ(lines[0], "push  path, compared with continuum");
  const std::regex exact(R"(  exact +converged +9 +20 +80 +470 us +3\.10e-08 % +0\.00\d+ %)");
  EXPECT_TRUE(std::regex_match(lines[5], exact)) << lines[5];
  const std::regex continuum(
      R"(  continuum +converged +67202 +20 +80 +132 s +0\.00240 % +reference)");
  EXPECT_TRUE(std::regex_match(lines[6], continuum)) << lines[6];
}

TEST(ComparisonTable, AlignsItsColumns) {
  Result result = only(0);
  std::get<PathResult>(result.studies[0].content).modelings[2].label = "prbm, größer";
  const std::vector<std::string> lines = lines_of(make_comparison_table(result, false));
  for (std::size_t i = 2; i < lines.size(); ++i) {
    EXPECT_EQ(display_width(lines[i]), display_width(lines[1])) << lines[i];
  }
}

TEST(ComparisonTable, ShowsEventsAndReasonsBelowTheRow) {
  const std::vector<std::string> lines = lines_of(make_comparison_table(only(1), false));
  ASSERT_GT(lines.size(), 6U);
  EXPECT_TRUE(std::regex_search(lines[3], std::regex("scmbm +stopped"))) << lines[3];
  EXPECT_EQ(lines[4], "      stability lost at load factor 0.57");
  EXPECT_EQ(lines[5].find("      stopped at load factor 0.65: No equilibrium"), 0U) << lines[5];
  for (const std::string& line : lines) EXPECT_LE(display_width(line), 100U);
}

TEST(ComparisonTable, ShowsSafetyWhereAStrengthIsStated) {
  Result result = only(0);
  auto& path = std::get<PathResult>(result.studies[0].content);
  path.strengths = {50.0, {}, 50.0};
  for (ModelingPath& modeling : path.modelings)
    for (PathState& state : modeling.states)
      state.peak_stresses = {40.0 * state.load_factor, 1e3, 10.0};
  for (PathState& state : path.modelings[3].states)
    state.peak_stresses[2] = 200.0 * state.load_factor;
  path.modelings[1].states.clear();
  const std::vector<std::string> lines = lines_of(make_comparison_table(result, false));
  ASSERT_EQ(lines.size(), 8U);
  EXPECT_TRUE(lines[1].ends_with("  difference  safety")) << lines[1];
  EXPECT_TRUE(lines[2].ends_with("  1.25")) << lines[2];
  EXPECT_TRUE(lines[3].ends_with("  -")) << lines[3];
  EXPECT_TRUE(lines[5].ends_with("  0.250")) << lines[5];
  EXPECT_EQ(lines[6], "      strength of e34 reached at load factor 0.25");
}

TEST(ComparisonTable, ColoursOnlyWhenAsked) {
  const Result result = sample::make_sample_result();
  const std::string plain = make_comparison_table(result, false);
  const std::string coloured = make_comparison_table(result, true);
  EXPECT_EQ(plain.find('\x1b'), std::string::npos);
  EXPECT_EQ(std::regex_replace(coloured, std::regex("\x1b\\[[0-9]*m"), ""), plain);
  EXPECT_NE(coloured.find("\x1b[31mstopped\x1b[0m"), std::string::npos);
}

TEST(ComparisonTable, PointsFromALinearStudyToItsFile) {
  EXPECT_EQ(make_comparison_table(only(3), false),
            "ellipses  linear, 7 compliance matrices: ellipses/ellipse.json\n");
}

TEST(ComparisonTable, CopesWithAModelingThatNeverBegan) {
  Result result = only(0);
  ModelingPath& modeling = std::get<PathResult>(result.studies[0].content).modelings[1];
  modeling = {};
  modeling.label = "scmbm";
  const std::string table = make_comparison_table(result, false);
  EXPECT_NE(table.find("      stopped no reason was given\n"), std::string::npos) << table;
}

std::vector<std::string> motion_lines(std::size_t study, const char* time_unit = "s") {
  Result result = sample::make_sample_motion();
  result.time_unit = time_unit;
  result.studies = {result.studies[study]};
  return lines_of(make_comparison_table(result, false));
}

TEST(ComparisonTable, ShowsFrequenciesInCyclesPerTimeUnit) {
  const std::vector<std::string> lines = motion_lines(0);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0], "sing  modes");
  EXPECT_EQ(lines[2],
            "  exact  converged  frequency unstable 37.17 69.3 Hz  error est. 2.00e-05 %  reference"
            "  8.30 ms");
  EXPECT_NE(motion_lines(0, "ms")[2].find(" 69.3 1/ms "), std::string::npos);
}

TEST(ComparisonTable, ShowsWhatAMotionCostAndHowFarItIsOff) {
  const std::vector<std::string> lines = motion_lines(1);
  EXPECT_EQ(lines[0], "turn  transient, compared with exact");
  EXPECT_NE(lines[1].find("energy error  error est.  difference  safety"), std::string::npos)
      << lines[1];
  const std::regex fine(
      R"(  fine +converged +198 +640 +1.72 s +3.30e-06 % +0.000460 % +[0-9.]+ % +[0-9.]+)");
  EXPECT_TRUE(std::regex_match(lines[lines.size() - 2], fine)) << lines[lines.size() - 2];
  EXPECT_EQ(lines.back().find("      strength of leaf reached at 0."), 0U) << lines.back();
  EXPECT_EQ(lines[6].find("      stopped at 0.62 s: The step shrank"), 0U) << lines[6];
  for (const std::string& line : lines) EXPECT_LE(display_width(line), 100U) << line;
}

TEST(ComparisonTable, SaysWhenAMotionReachesAStrength) {
  Result result = sample::make_sample_motion();
  result.studies = {result.studies[1]};
  auto& motion = std::get<MotionResult>(result.studies[0].content);
  for (MotionState& moment : motion.modelings[3].states)
    moment.state.peak_stresses = {0.0, 100.0 * moment.time};
  const auto lines = lines_of(make_comparison_table(result, false));
  EXPECT_EQ(lines.back(), "      strength of leaf reached at 0.5 s");
}

TEST(ComparisonTable, ShowsTheHighestPeakOfAResponse) {
  const std::vector<std::string> lines = motion_lines(2);
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[0], "shake  response, compared with exact");
  EXPECT_TRUE(lines[1].ends_with("  highest peak")) << lines[1];
  const std::regex exact(
      "  exact +converged +9 +16.6 ms +0.000150 % +reference +piston.x [0-9.]+ mm at 1[0-9.]+ Hz");
  EXPECT_TRUE(std::regex_match(lines[3], exact)) << lines[3];
}

TEST(ComparisonTable, CopesWithMotionsThatNeverBegan) {
  Result result = sample::make_sample_motion();
  auto& motion = std::get<MotionResult>(result.studies[1].content).modelings[0];
  motion = {};
  motion.label = "prbm";
  auto& response = std::get<ResponseResult>(result.studies[2].content).modelings[0];
  response = {};
  response.label = "prbm";
  const std::string table = make_comparison_table(result, false);
  EXPECT_NE(table.find("      stopped no reason was given\n"), std::string::npos) << table;
  EXPECT_NE(table.find("  none\n"), std::string::npos) << table;
}

TEST(WrapText, BreaksBetweenWords) {
  EXPECT_EQ(wrap_text("one two three", 7), (std::vector<std::string>{"one two", "three"}));
  EXPECT_EQ(wrap_text("unbreakable x", 4), (std::vector<std::string>{"unbreakable", "x"}));
  EXPECT_TRUE(wrap_text("  ", 4).empty());
}

TEST(DisplayWidth, CountsCodePoints) { EXPECT_EQ(display_width("größer"), 6U); }

}  // namespace
}  // namespace flexura

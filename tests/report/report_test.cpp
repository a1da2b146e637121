#include "flexura/report/report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "flexura/report/assets.hpp"
#include "tests/report/sample_motion.hpp"
#include "tests/report/sample_result.hpp"
#include "tests/report/sample_turn.hpp"

namespace flexura {
namespace {

/// What the page's scripts will parse.
std::string data_text(const std::string& html) {
  const std::string opening = "<script type=\"application/json\" id=\"data\">";
  const std::size_t begin = html.find(opening) + opening.size();
  return html.substr(begin, html.find("</script>", begin) - begin);
}

nlohmann::json data_of(const Result& result) {
  return nlohmann::json::parse(data_text(make_report(result)));
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++found;
  }
  return found;
}

/// One body on one flexure, with nothing computed.
Result empty_result() {
  Result result = sample::make_sample_result();
  result.studies.clear();
  return result;
}

TEST(Report, AssetsAreEmbeddedWhole) {
  std::ifstream file(FLEXURA_SOURCE_DIR "/flexura/report/page/style.css", std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(report_asset("style.css"), text);
  EXPECT_NE(report_asset("d3.min.js").find("d3js.org v5"), std::string_view::npos);
  EXPECT_TRUE(report_asset("no_such_file.js").empty());
}

TEST(Report, NamesNothingOutsideItself) {
  const std::string html = make_report(empty_result());
  EXPECT_EQ(count(html, " src="), 0U);
  EXPECT_EQ(count(html, "@import"), 0U);
  EXPECT_EQ(count(html, "<link"), 1U);  // the icon, which is empty data
  EXPECT_NE(html.find("<link rel=\"icon\" href=\"data:,\">"), std::string::npos);
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
}

TEST(Report, FillsEveryPlaceholderOnceAndOnlyInTheTemplate) {
  Result result = empty_result();
  result.title = "plain";
  EXPECT_EQ(make_report(result).find("{{"), std::string::npos);
  result.title = "{{asset d3.min.js}}";
  const std::string html = make_report(result);
  EXPECT_EQ(count(html, "<h1>{{asset d3.min.js}}</h1>"), 1U);
  EXPECT_EQ(count(html, "d3js.org v5"), 1U);
}

TEST(Report, UserTextCannotBecomeMarkup) {
  Result result = empty_result();
  result.title = "<img src=x onerror=alert(1)> & \"quotes\" 'too'";
  result.model_file = "</script><script>alert(1)</script><!--";
  const std::string html = make_report(result);
  EXPECT_EQ(html.find("<img"), std::string::npos);
  EXPECT_EQ(html.find("alert(1)</script>"), std::string::npos);
  EXPECT_NE(html.find("&lt;img src=x onerror=alert(1)&gt; &amp; &quot;quotes&quot; &#39;too&#39;"),
            std::string::npos);
  EXPECT_EQ(data_text(html).find('<'), std::string::npos);
  EXPECT_EQ(data_of(result)["model_file"], result.model_file);
  EXPECT_EQ(data_of(result)["title"], result.title);
}

TEST(Report, MendsNamesThatAreNoUnicode) {
  Result result = empty_result();
  result.model_file = "broken \xff name.toml";
  EXPECT_EQ(data_of(result)["model_file"], "broken \xEF\xBF\xBD name.toml");
}

TEST(Report, CarriesSevenDigitsAndNullForWhatIsNoNumber) {
  Result result = sample::make_sample_result();
  auto& path = std::get<PathResult>(result.studies[0].content);
  path.modelings[0].states[1].points[0] = {1.0 / 3.0, std::nan("")};
  path.modelings[0].seconds = std::numeric_limits<double>::infinity();
  const nlohmann::json modeling = data_of(result)["studies"][0]["path"]["modelings"][0];
  EXPECT_EQ(modeling["states"][1]["points"][0][0], 0.3333333);
  EXPECT_TRUE(modeling["states"][1]["points"][0][1].is_null());
  EXPECT_TRUE(modeling["seconds"].is_null());
}

TEST(Report, SaysWhichBodyCarriesAPoint) {
  const nlohmann::json path = data_of(sample::make_sample_result())["studies"][0]["path"];
  EXPECT_EQ(path["points"], nlohmann::json({"link4.E"}));
  EXPECT_EQ(path["owners"], nlohmann::json::array({2}));
}

TEST(Report, KnowsWhereStationsAreAndHowSafe) {
  const Result result = sample::make_sample_result();
  const auto& path = std::get<PathResult>(result.studies[2].content);
  const nlohmann::json data = data_of(result)["studies"];
  const nlohmann::json& prbm = data[2]["path"]["modelings"][2];
  const MemberStation& station = path.modelings[2].members[1][2];
  const nlohmann::json& row = prbm["members"][1][2];
  ASSERT_EQ(row.size(), 7U);
  EXPECT_NEAR(row[5], station.section.position.x, 1e-5);
  EXPECT_NEAR(row[6], station.section.position.y, 1e-5);
  EXPECT_EQ(prbm["safety"]["factor"], 0.8333333);
  EXPECT_EQ(prbm["safety"]["reached"]["flexure"], 0);
  EXPECT_NEAR(prbm["safety"]["reached"]["load_factor"], 30.0 / 36.0, 1e-6);
  EXPECT_TRUE(data[2]["path"]["modelings"][0]["safety"]["reached"].is_null());
  EXPECT_TRUE(data[0]["path"]["modelings"][0]["safety"].is_null());
}

TEST(Report, HoldsAntipolarAsPointAndDirection) {
  const Result result = sample::make_sample_result();
  const auto& linear = std::get<LinearResult>(result.studies[3].content);
  const nlohmann::json records = data_of(result)["studies"][3]["linear"]["records"];
  ASSERT_EQ(records.size(), linear.records.size());
  const Line2& line = *linear.records.back().antipolar;
  const nlohmann::json& drawn = records.back()["antipolar"];
  const Vec2 point{drawn["point"][0], drawn["point"][1]};
  const Vec2 direction{drawn["direction"][0], drawn["direction"][1]};
  EXPECT_NEAR(dot(line.normal, point - line.origin), line.offset, 1e-5);
  EXPECT_NEAR(dot(line.normal, direction), 0.0, 1e-6);
}

// The pages that tests/browser opens: written where the environment says, if it does.
void write_where_told(const std::string& html, const char* variable) {
  const char* file = std::getenv(variable);
  if (file == nullptr) return;
  std::ofstream stream(file, std::ios::binary);
  stream << html;
  stream.close();
  EXPECT_TRUE(stream.good()) << file;
}

TEST(Report, ShowsTheSample) {
  const std::string html = make_report(sample::make_sample_result());
  EXPECT_EQ(html.rfind("<!DOCTYPE html>", 0), 0U);
  EXPECT_EQ(html.substr(html.size() - 8), "</html>\n");
  EXPECT_LT(html.size(), 1'500'000U);
  write_where_told(html, "FLEXURA_SAMPLE_REPORT");
}

TEST(Report, ShowsTheSampleOfMotion) {
  const std::string html = make_report(sample::make_sample_motion());
  EXPECT_LT(html.size(), 1'500'000U);
  write_where_told(html, "FLEXURA_SAMPLE_MOTION");
}

TEST(Report, HasThePageOfLinkagesOnlyForLinkages) {
  const std::string definition = "const LinkageStudy = ";
  EXPECT_EQ(make_report(sample::make_sample_motion()).find(definition), std::string::npos);
  EXPECT_NE(make_report(sample::make_sample_turn()).find(definition), std::string::npos);
}

TEST(Report, ShowsTheSampleOfTurns) {
  const std::string html = make_report(sample::make_sample_turn());
  EXPECT_LT(html.size(), 2'500'000U);
  write_where_told(html, "FLEXURA_SAMPLE_TURN");
}

}  // namespace
}  // namespace flexura

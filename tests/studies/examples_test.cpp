// Every example is a valid model, and all its studies finish.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "flexura/io/model_reader.hpp"
#include "flexura/pictures/picture.hpp"
#include "flexura/studies/run_studies.hpp"
#include "tests/pictures/picture_checks.hpp"

namespace flexura {
namespace {

std::vector<std::string> examples() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(FLEXURA_SOURCE_DIR "/examples"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path().stem().string());
  std::sort(files.begin(), files.end());
  return files;
}

class Example : public ::testing::TestWithParam<std::string> {};

#ifdef __SANITIZE_ADDRESS__
/// Minutes there, and smaller tests walk through the same code.
bool takes_long(const std::string& name) {
  return name == "turcic_midha_four_bar" || name == "punching_machine" || name == "plate_follower";
}
#else
bool takes_long(const std::string& /*name*/) { return false; }
#endif

TEST_P(Example, Runs) {
  if (takes_long(GetParam())) GTEST_SKIP();
  const ModelReading reading =
      read_model(std::string(FLEXURA_SOURCE_DIR "/examples/") + GetParam() + ".toml");
  ASSERT_TRUE(reading.model.has_value());
  const Result result = run_studies(*reading.model, {});
  EXPECT_FALSE(result.studies.empty());
  for (const StudyResult& study : result.studies) {
    if (can_be_drawn(study.kind)) {
      const Picture picture = make_picture(result, {study.name});
      EXPECT_EQ(picture.error, "") << study.name;
      EXPECT_EQ(pictures::picture_faults(picture.svg), std::vector<std::string>{}) << study.name;
      EXPECT_LT(picture.svg.size(), 150000U) << study.name;
    }
    EXPECT_TRUE(study.termination.converged()) << study.name << ": " << study.termination.reason;
  }
}

INSTANTIATE_TEST_SUITE_P(Examples, Example, ::testing::ValuesIn(examples()),
                         [](const auto& tested) { return tested.param; });

/// The bistable beam: two snap forces, three equilibria of which the middle one is unstable.
TEST(BistableBeam, HasThreeEquilibria) {
  const ModelReading reading = read_model(FLEXURA_SOURCE_DIR "/examples/bistable_beam.toml");
  ASSERT_TRUE(reading.model.has_value());
  const Result result = run_studies(*reading.model, {});
  const auto& path = std::get<PathResult>(result.studies.at(0).content);
  for (const ModelingPath& modeling : path.modelings) {
    if (modeling.modeling == "linear") continue;
    std::string kinds;
    std::vector<bool> stable;
    for (const ReactionEvent& event : modeling.reaction_events) {
      kinds += event.kind == ReactionEvent::Kind::halt ? 'h' : 'z';
      if (event.kind == ReactionEvent::Kind::zero) stable.push_back(event.stable);
    }
    EXPECT_EQ(kinds, "zhzhz") << modeling.label;
    EXPECT_EQ(stable, (std::vector<bool>{true, false, true})) << modeling.label;
  }
}

}  // namespace
}  // namespace flexura

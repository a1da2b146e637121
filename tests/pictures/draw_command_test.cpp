// `flexura draw` as its users call it: what it writes, and what it says where it does not.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/pictures/picture_checks.hpp"
#include "tests/support/folder_test.hpp"
#include "tests/support/shell.hpp"

namespace flexura {
namespace {

namespace fs = std::filesystem;

using Answer = testing::ShellAnswer;

class DrawCommand : public testing::FolderTest {
 protected:
  Answer draw(const std::string& model, const std::string& options) const {
    return testing::ask_shell("cd '" + top_.string() + "' && '" FLEXURA_EXECUTABLE "' draw '" +
                              model + "' " + options + " 2>&1 </dev/null");
  }

  static std::string example(const std::string& name) {
    return std::string(FLEXURA_SOURCE_DIR "/examples/") + name + ".toml";
  }

  std::size_t count_files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(top_), {}));
  }
};

TEST_F(DrawCommand, WritesAMovingPictureNamedAfterTheModel) {
  const Answer answer = draw(example("parallelogram_stage"), "");
  EXPECT_EQ(answer.status, 0) << answer.text;
  EXPECT_EQ(answer.text, "parallelogram_stage.svg written\n");
  const std::string svg = read("parallelogram_stage.svg");
  EXPECT_EQ(pictures::picture_faults(svg), std::vector<std::string>{});
  EXPECT_GT(pictures::count_of(svg, "<animate"), 0U);
  EXPECT_EQ(pictures::count_of(svg, "class=\"spring\""), 1U);
  EXPECT_EQ(count_files(), 1U) << "something was left behind";
}

TEST_F(DrawCommand, WritesTheSameAgain) {
  EXPECT_EQ(draw(example("parallelogram_stage"), "-o a.svg").status, 0);
  EXPECT_EQ(draw(example("parallelogram_stage"), "-o into/b.svg").status, 0);
  EXPECT_EQ(read("a.svg"), read("into/b.svg"));
}

TEST_F(DrawCommand, DrawsTheModelingAndStudyAskedFor) {
  const std::string stage = example("stage_frequency_response");
  EXPECT_EQ(draw(stage, "--study frequencies --mode 2 --modeling linear -q -o a.svg").text, "");
  EXPECT_EQ(pictures::count_of(read("a.svg"), "mode 2"), 1U);
  EXPECT_EQ(draw(stage, "--study payload --still -q").status, 0);
}

TEST_F(DrawCommand, SuggestsTheNearestName) {
  const std::string stage = example("stage_frequency_response");
  const Answer study = draw(stage, "--study paylod");
  EXPECT_EQ(study.status, 2);
  EXPECT_NE(study.text.find("no study 'paylod'; did you mean 'payload'?"), std::string::npos)
      << study.text;
  const Answer modeling = draw(stage, "--study payload --modeling exat");
  EXPECT_EQ(modeling.status, 2);
  EXPECT_NE(modeling.text.find("'exat'; did you mean 'exact'?"), std::string::npos)
      << modeling.text;
  EXPECT_EQ(count_files(), 0U);
}

TEST_F(DrawCommand, SaysWhatItCannotDraw) {
  const Answer answer = draw(example("stage_frequency_response"), "--study shaker");
  EXPECT_EQ(answer.status, 2);
  EXPECT_NE(answer.text.find("'shaker' is of kind response, which has no shape to draw"),
            std::string::npos)
      << answer.text;
  const Answer mode = draw(example("stage_frequency_response"), "--study frequencies --mode 900");
  EXPECT_EQ(mode.status, 2);
  EXPECT_NE(mode.text.find("has no mode 900"), std::string::npos) << mode.text;
  EXPECT_EQ(count_files(), 0U);
}

/// A leaf that cannot stretch, asked to reach further than it is long.
constexpr const char* too_far = R"(
flexura = 1
[units]
length = "mm"
force = "N"
time = "s"
[materials.steel]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
[sections.strip]
rectangle = { thickness = 0.2, width = 5 }
[bodies.ground]
fixed = true
[bodies.tip]
[flexures.leaf]
between = ["ground", "tip"]
axis = { line = [[0, 0], [50, 0]] }
material = "steel"
section = "strip"
[studies.reach]
kind = "path"
prescribe = [{ on = "tip", y = 80 }]
modelings = [{ name = "exact", axial = false, shear = false }]
)";

TEST_F(DrawCommand, DrawsWhatConvergedOfAStudyThatStopped) {
  std::ofstream(top_ / "too_far.toml") << too_far;
  const Answer answer = draw("too_far.toml", "");
  EXPECT_EQ(answer.status, 1) << answer.text;
  EXPECT_NE(answer.text.find("what converged is drawn"), std::string::npos) << answer.text;
  const std::string svg = read("too_far.svg");
  EXPECT_EQ(pictures::picture_faults(svg), std::vector<std::string>{});
  EXPECT_GT(pictures::count_of(svg, "<animate"), 0U);
}

}  // namespace
}  // namespace flexura

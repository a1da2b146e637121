#include <gtest/gtest.h>

#include "flexura/io/model_reader.hpp"
#include "tests/io/model_text.hpp"

namespace flexura {
namespace {

using testing::ModelText;
using testing::read_valid;

PathStudy read_path(const std::string& body) {
  ModelText text;
  text.studies = "[studies.push]\nkind = \"path\"\n" + body;
  const Model model = read_valid(text.text());
  if (model.studies.empty()) return {};
  return std::get<PathStudy>(model.studies[0].kind);
}

PathStudy with_modelings(const std::string& modelings, const std::string& more = "") {
  return read_path("loads = [{ on = \"stage\", moment = 1.0 }]\nmodelings = " + modelings + "\n" +
                   more);
}

template <typename Settings>
const Settings& settings(const PathStudy& study, std::size_t i) {
  return std::get<Settings>(study.modelings.at(i).kind);
}

TEST(Studies, Loads) {
  const PathStudy study = read_path(
      "loads = [{ on = \"stage.P\", force = [\"2 mN\", 3], moment = \"1 N m\", follower = true },"
      " { on = \"stage\", moment = 2 }]\nmodelings = [\"exact\"]\nsteps = 7\n");
  ASSERT_EQ(study.loads.size(), 2u);
  EXPECT_EQ(study.loads[0].point, 0u);
  EXPECT_EQ(study.loads[0].force, (Vec2{0.002, 3.0}));
  EXPECT_EQ(study.loads[0].moment, 1000.0);
  EXPECT_TRUE(study.loads[0].follower);
  EXPECT_FALSE(study.loads[1].point.has_value());
  EXPECT_FALSE(study.loads[1].follower);
  EXPECT_EQ(study.steps, 7);
}

TEST(Studies, ModelingsByName) {
  const PathStudy study = with_modelings(R"(["linear", "scmbm", "prbm", "exact", "beam"])");
  ASSERT_EQ(study.modelings.size(), 5u);
  EXPECT_EQ(study.steps, 20);
  for (const ModelingSettings& modeling : study.modelings) {
    EXPECT_EQ(modeling.label, modeling_name(modeling));
    EXPECT_TRUE(modeling.axial);
    EXPECT_TRUE(modeling.shear);
    EXPECT_EQ(modeling.tolerance, 1e-8);
  }
  EXPECT_EQ(settings<ScmbmSettings>(study, 1).at, ScmbmSettings::At::centre);
  EXPECT_TRUE(
      std::holds_alternative<PrbmEqualSprings>(settings<PrbmSettings>(study, 2).parameters));
  EXPECT_FALSE(settings<ExactSettings>(study, 3).modes.has_value());
  EXPECT_EQ(settings<BeamSettings>(study, 4).elements, 16);
}

TEST(Studies, ModelingsWithSettings) {
  const PathStudy study = with_modelings(R"([
    { name = "scmbm", at = "end", label = "at_end", axial = false },
    { name = "exact", modes = 12, shear = false, tolerance = 1e-10 },
    { name = "beam", theory = "exact", elements = 4, order = 3 },
  ])");
  ASSERT_EQ(study.modelings.size(), 3u);
  EXPECT_EQ(settings<ScmbmSettings>(study, 0).at, ScmbmSettings::At::end);
  EXPECT_EQ(study.modelings[0].label, "at_end");
  EXPECT_FALSE(study.modelings[0].axial);
  EXPECT_TRUE(study.modelings[0].shear);
  EXPECT_EQ(settings<ExactSettings>(study, 1).modes, 12);
  EXPECT_FALSE(study.modelings[1].shear);
  EXPECT_EQ(study.modelings[1].tolerance, 1e-10);
  EXPECT_EQ(settings<BeamSettings>(study, 2).elements, 4);
  EXPECT_EQ(settings<BeamSettings>(study, 2).order, 3);
}

TEST(Studies, PrbmParameters) {
  const PathStudy study = with_modelings(R"([
    { name = "prbm", label = "su", parameters = "su" },
    { name = "prbm", label = "howell", parameters = "howell" },
    { name = "prbm", label = "axial", parameters = { model = "howell", load_ratio = -1.5 } },
    { name = "prbm", label = "own", parameters = { lengths = [0.1, 0.9], stiffness = [2.5] } },
    { name = "prbm", label = "any", parameters = { joints = [[0, 0.25]], stiffness = [3] } },
  ])");
  const auto parameters = [&](std::size_t i) {
    return settings<PrbmSettings>(study, i).parameters;
  };
  ASSERT_EQ(study.modelings.size(), 5u);
  EXPECT_TRUE(std::holds_alternative<PrbmSu>(parameters(0)));
  EXPECT_FALSE(std::get<PrbmHowell>(parameters(1)).load_ratio.has_value());
  EXPECT_EQ(std::get<PrbmHowell>(parameters(2)).load_ratio, -1.5);
  EXPECT_EQ(std::get<PrbmSegments>(parameters(3)).lengths, (std::vector<double>{0.1, 0.9}));
  EXPECT_EQ(std::get<PrbmSegments>(parameters(3)).stiffness, (std::vector<double>{2.5}));
  EXPECT_EQ(std::get<PrbmJoints>(parameters(4)).joints, (std::vector<Vec2>{{0.0, 0.25}}));
}

TEST(Studies, Reference) {
  EXPECT_EQ(with_modelings(R"(["exact", "linear"])").reference, 0u);
  EXPECT_EQ(with_modelings(R"(["linear", "scmbm"])").reference, 1u);
  EXPECT_EQ(with_modelings(R"(["linear", { name = "exact", label = "a" },
                              { name = "exact", label = "b" }])")
                .reference,
            1u);
  EXPECT_EQ(with_modelings(R"(["exact", { name = "beam", label = "fine" }, "scmbm"])",
                           "reference = \"fine\"\n")
                .reference,
            1u);
}

TEST(Studies, KeptFields) {
  const auto text = [](const std::string& keys) {
    testing::ModelText parts;
    parts.studies =
        "[studies.push]\nkind = \"path\"\nloads = [{ on = \"stage\", moment = 1 }]\n"
        "modelings = [\"continuum\"]\n" +
        keys;
    return parts.text();
  };
  const auto kept = [&](const std::string& keys) {
    return std::get<PathStudy>(testing::read_valid(text(keys)).studies.at(0).kind).stress_fields;
  };
  EXPECT_EQ(kept(""), PathStudy::KeptFields::last);
  EXPECT_EQ(kept("fields = \"last\"\n"), PathStudy::KeptFields::last);
  EXPECT_EQ(kept("fields = \"none\"\n"), PathStudy::KeptFields::none);
  EXPECT_EQ(kept("fields = \"every_step\"\n"), PathStudy::KeptFields::every_step);
  const auto wrong = read_model_text(text("fields = \"every_stp\"\n"), {});
  EXPECT_NE(testing::messages(wrong.diagnostics).find("every_step"), std::string::npos);
}

TEST(Studies, LinearAndInverse) {
  ModelText text;
  text.studies = R"([studies.ellipse]
kind = "linear"
shear = false
[studies.shape]
kind = "inverse"
relative = [{ flexure = "leaf", x = "1 um", rotation = 0.2 }]
modelings = ["linear"]
)";
  const Model model = read_valid(text.text());
  ASSERT_EQ(model.studies.size(), 2u);
  const auto& linear = std::get<LinearStudy>(model.studies[0].kind);
  EXPECT_TRUE(linear.axial);
  EXPECT_FALSE(linear.shear);
  const auto& inverse = std::get<InverseStudy>(model.studies[1].kind);
  EXPECT_EQ(inverse.steps, 1);
  EXPECT_EQ(inverse.relative.at(0).displacement, (Vec2{1e-3, 0.0}));
  EXPECT_EQ(inverse.relative.at(0).rotation, 0.2);
  EXPECT_EQ(inverse.relative.at(0).at, RelativeDisplacement::At::end);
}

}  // namespace
}  // namespace flexura

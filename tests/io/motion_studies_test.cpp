#include <gtest/gtest.h>

#include <numbers>

#include "tests/io/model_text.hpp"

namespace flexura {
namespace {

using testing::ModelText;
using testing::read_valid;

constexpr double turn = 2.0 * std::numbers::pi;

/// A path `push` first, then a study whose lines these are.
Model read(const std::string& lines, const std::string& time = "s") {
  ModelText text;
  text.units = "[units]\nlength = \"mm\"\nforce = \"N\"\ntime = \"" + time + "\"\n";
  text.materials += "density = \"7850 kg/m^3\"\n";
  text.studies =
      "[studies.push]\nkind = \"path\"\nloads = [{ on = \"stage\", moment = 1 }]\n"
      "modelings = [\"exact\"]\n[studies.own]\nmodelings = [\"linear\", \"exact\"]\n" +
      lines;
  return read_valid(text.text());
}

template <typename StudyKind>
StudyKind own(const Model& model) {
  if (model.studies.size() < 2) return {};
  return std::get<StudyKind>(model.studies[1].kind);
}

TEST(Modes, Defaults) {
  const auto study = own<ModesStudy>(read("kind = \"modes\"\n"));
  EXPECT_FALSE(study.about.has_value());
  EXPECT_FALSE(study.curve);
  EXPECT_EQ(study.count, 6);
  EXPECT_EQ(study.solver, ModesStudy::Solver::automatic);
  EXPECT_TRUE(study.inertia.translation);
  EXPECT_FALSE(study.inertia.rotary.has_value());
  EXPECT_TRUE(study.inertia.shear_rotary);
  EXPECT_FALSE(study.inertia.lumped);
  EXPECT_EQ(study.modelings.size(), 2u);
  EXPECT_EQ(study.reference, 1u);
}

TEST(Modes, AboutAStateOfAPath) {
  const auto study = own<ModesStudy>(
      read("kind = \"modes\"\nabout = { study = \"push\", load_factor = 0.25, curve = true }\n"
           "count = 3\nsolver = \"sparse\"\nrotary_inertia = false\nshear_rotary_inertia = false\n"
           "translation_inertia = false\nreference = \"linear\"\n"));
  ASSERT_TRUE(study.about.has_value());
  EXPECT_EQ(study.about->study, 0u);
  EXPECT_EQ(study.about->load_factor, 0.25);
  EXPECT_TRUE(study.curve);
  EXPECT_EQ(study.count, 3);
  EXPECT_EQ(study.solver, ModesStudy::Solver::sparse);
  EXPECT_EQ(study.inertia.rotary, false);
  EXPECT_FALSE(study.inertia.shear_rotary);
  EXPECT_FALSE(study.inertia.translation);
  EXPECT_EQ(study.reference, 0u);
}

// Names lead to studies further down as well.
TEST(Modes, LumpedAboutALaterStudy) {
  ModelText text;
  text.materials += "density = \"7850 kg/m^3\"\n";
  text.studies =
      "[studies.own]\nkind = \"modes\"\nabout = { study = \"push\" }\nmass = \"lumped\"\n"
      "modelings = [\"beam\", { name = \"beam\", theory = \"von_karman\", label = \"vk\" }]\n"
      "[studies.push]\nkind = \"path\"\nloads = [{ on = \"stage\", moment = 1 }]\n"
      "modelings = [\"exact\"]\n";
  const Model model = read_valid(text.text());
  ASSERT_EQ(model.studies.size(), 2u);
  const auto& study = std::get<ModesStudy>(model.studies[0].kind);
  EXPECT_TRUE(study.inertia.lumped);
  EXPECT_EQ(study.about->study, 1u);
  EXPECT_EQ(study.about->load_factor, 1.0);
}

TEST(Transient, Defaults) {
  const auto study = own<TransientStudy>(
      read("kind = \"transient\"\nduration = \"2 ms\"\ngravity = [0, \"-9.81 m/s^2\"]\n"));
  EXPECT_EQ(study.duration, 2e-3);
  EXPECT_EQ(study.fields.gravity, (Vec2{0.0, -9810.0}));
  EXPECT_TRUE(study.fields.constant);
  EXPECT_FALSE(study.from.has_value());
  EXPECT_FALSE(study.step.has_value());
  EXPECT_EQ(study.tolerance, 1e-5);
  EXPECT_EQ(study.method, TransientStudy::Method::radau);
  EXPECT_EQ(study.outputs, 200);
  EXPECT_TRUE(study.estimate);
  EXPECT_EQ(study.damping.modal, 0.0);
}

TEST(Transient, LoadsAndMotionsHaveHistories) {
  const auto study = own<TransientStudy>(
      read("kind = \"transient\"\nduration = 2\nloads = [\n"
           "  { on = \"stage\", moment = 1, follower = true, history = { ramp = [0, 1] } },\n"
           "  { on = \"leaf\", distributed = [0, 0.1] }, { on = \"stage.P\", force = [1, 0] }]\n"
           "prescribe = [{ on = \"stage\", x = 0, y = 3, history = \"= t^2\" }]\n"));
  ASSERT_EQ(study.loads.size(), 2u);
  EXPECT_TRUE(study.loads[0].follower);
  EXPECT_EQ(std::get<RampHistory>(study.loads[0].history).end, 1.0);
  EXPECT_EQ(std::get<StepHistory>(study.loads[1].history).at, 0.0);  // there from the start
  ASSERT_EQ(study.fields.spread.size(), 1u);
  EXPECT_EQ(study.fields.spread[0].per_length, (Vec2{0.0, 0.1}));
  ASSERT_EQ(study.prescribe.size(), 1u);
  EXPECT_EQ(evaluate_history(study.prescribe[0].history, 3.0).value, 9.0);
}

TEST(Transient, MethodsAndDamping) {
  const std::string start =
      "kind = \"transient\"\nfrom = { study = \"push\", load_factor = 0.5 }\n";
  auto study = own<TransientStudy>(
      read(start +
           "duration = 1\nmethod = \"generalized_alpha\"\nspectral_radius = 0.6\n"
           "tolerance = 1e-4\noutputs = 10\nestimate = false\ndamping = { modal = 0.02 }\n"));
  EXPECT_EQ(study.from->load_factor, 0.5);
  EXPECT_EQ(study.method, TransientStudy::Method::generalized_alpha);
  EXPECT_EQ(study.spectral_radius, 0.6);
  EXPECT_EQ(study.tolerance, 1e-4);
  EXPECT_EQ(study.outputs, 10);
  EXPECT_FALSE(study.estimate);
  EXPECT_EQ(study.damping.modal, 0.02);
  study = own<TransientStudy>(
      read(start + "duration = 1\nmethod = \"energy_momentum\"\nstep = \"1 ms\"\n"
                   "damping = { mass = \"0.1 /s\", stiffness = \"2 ms\" }\n",
           "ms"));
  EXPECT_EQ(study.method, TransientStudy::Method::energy_momentum);
  EXPECT_EQ(study.step, 1.0);
  EXPECT_DOUBLE_EQ(study.damping.mass, 1e-4);
  EXPECT_EQ(study.damping.stiffness, 2.0);
}

TEST(Transient, GoesOnWhereAnotherEnded) {
  const Model model = read(
      "kind = \"transient\"\nduration = 1\nfrom = { study = \"push\" }\n"
      "[studies.later]\nkind = \"transient\"\nduration = 1\nfrom = { study = \"own\" }\n"
      "modelings = [\"exact\"]\n");
  ASSERT_EQ(model.studies.size(), 3u);
  EXPECT_EQ(std::get<TransientStudy>(model.studies[2].kind).from->study, 1u);
}

TEST(Response, CountsInCyclesAndKeepsRadians) {
  const auto study = own<ResponseStudy>(
      read("kind = \"response\"\nloads = [{ on = \"stage\", force = [1, 0] }]\n"
           "about = { study = \"push\" }\ndamping = { stiffness = 0.01 }\n"
           "frequencies = { from = \"1 Hz\", to = 2, count = 50, logarithmic = false }\n",
           "ms"));
  EXPECT_DOUBLE_EQ(study.from, 1e-3 * turn);
  EXPECT_DOUBLE_EQ(study.to, 2.0 * turn);  // plain numbers: cycles per millisecond
  EXPECT_EQ(study.count, 50);
  EXPECT_FALSE(study.logarithmic);
  EXPECT_EQ(study.about->study, 0u);
  EXPECT_EQ(study.damping.stiffness, 0.01);
  EXPECT_EQ(study.reference, 1u);
}

TEST(Response, Defaults) {
  const auto study =
      own<ResponseStudy>(read("kind = \"response\"\nloads = [{ on = \"stage\", force = [1, 0] }]\n"
                              "frequencies = { from = 1, to = 2 }\n"));
  EXPECT_EQ(study.count, 400);
  EXPECT_TRUE(study.logarithmic);
  EXPECT_FALSE(study.about.has_value());
}

}  // namespace
}  // namespace flexura

// Links whose outline Flexura meshes: notches and holes against published factors, vibrations
// against closed forms and strips.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flexura/geometry/outline_mesh.hpp"
#include "tests/support/fields.hpp"
#include "tests/support/frequencies.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/mechanism.hpp"
#include "tests/support/modelings.hpp"

namespace flexura::testing {
namespace {

constexpr double pi = std::numbers::pi;

struct Attachments {
  const char* base = "left";
  const char* action = "right";
};

MeshLink meshed(const std::vector<OutlineStep>& border, const std::vector<OutlineLoop>& holes,
                double size, double depth, const Attachments& at = {}) {
  Outline outline;
  std::string fault;
  outline.loops.push_back(make_loop(border, fault));
  EXPECT_EQ(fault, "");
  outline.loops.insert(outline.loops.end(), holes.begin(), holes.end());
  EXPECT_FALSE(find_outline_fault(outline).has_value());
  orient(outline);
  OutlineMesh made = mesh_outline(outline, size, 2);
  MeshLink link;
  link.base = made.named.at(at.base);
  link.action = made.named.at(at.action);
  link.mesh = std::move(made.mesh);
  link.depth = depth;
  EXPECT_FALSE(find_mesh_fault(link).has_value());
  return link;
}

std::vector<OutlineStep> rectangle(double length, double height) {
  const double h = 0.5 * height;
  return {{{0.0, -h}, 0.0, 0.0, "left"},
          {{length, -h}, 0.0, 0.0, ""},
          {{length, h}, 0.0, 0.0, "right"},
          {{0.0, h}, 0.0, 0.0, ""}};
}

/// A circular hinge between blocks, as ContinuumNotch has it: Smith's fit, good to a per cent or
/// two, and the strip of the same profile, without the blocks.
TEST(ContinuumOutline, CircularHingeIsAsSoftAsPublished) {
  constexpr double radius = 4.0, width = 10.0, block = 2.0, thickness = 1.0;
  constexpr double h = radius + 0.5 * thickness;
  const std::vector<OutlineStep> border = {{{-block, -h}, 0.0, 0.0, "left"},
                                           {{0.0, -h}, 0.0, 0.0, ""},
                                           {{2.0 * radius, -h}, -pi, 0.0, ""},
                                           {{2.0 * radius + block, -h}, 0.0, 0.0, ""},
                                           {{2.0 * radius + block, h}, 0.0, 0.0, "right"},
                                           {{2.0 * radius, h}, 0.0, 0.0, ""},
                                           {{0.0, h}, -pi, 0.0, ""},
                                           {{-block, h}, 0.0, 0.0, ""}};
  Mechanism hinge;
  hinge.material(210e3, 0.3).section(RectangleSection{1.0, 1.0}).fixed("ground").body("tip");
  hinge.link("ground", "tip", meshed(border, {}, 0.6, width));
  RectangleSection section{thickness, width};
  section.profile = NotchProfile{radius, radius, true};
  Mechanism strip;
  strip.material(210e3, 0.3).section(section).fixed("ground").body("tip");
  strip.flexure("ground", "tip", LineAxis{{0.0, 0.0}, {2.0 * radius, 0.0}});
  const auto turn = [](const Mechanism& of) {
    ContinuumSettings free_faces;
    free_faces.contracting = true;
    return final_pose(of, {of.load("tip", {}, 1.0)}, continuum(free_faces, 1e-8), 1).rotation;
  };
  const double fit = 24.0 * (0.565 * thickness / radius + 0.166) * radius /
                     (210e3 * width * thickness * thickness * thickness);
  note_measured("fit", turn(hinge) / fit - 1.0);
  note_measured("strip", turn(hinge) / turn(strip) - 1.0);
  EXPECT_NEAR(turn(hinge) / fit, 1.0, 0.02);
  EXPECT_NEAR(turn(hinge) / turn(strip), 1.0, 0.01);
}

/// A plate in tension with a hole of a fifth of its width: by Heywood's formula (Pilkey, Peterson's
/// Stress Concentration Factors, chart 4.1) the stress at the hole is (2 + (1 - d/W)^3)/(1 - d/W)
/// times that far away, within a per cent.
TEST(ContinuumOutline, HoleConcentratesTheStressAsPublished) {
  constexpr double breadth = 20.0, length = 60.0, radius = 2.0, force = 100.0;
  Mechanism plate;
  plate.material(210e3, 0.3).section(RectangleSection{1.0, 1.0}).fixed("ground").body("tip");
  plate.link("ground", "tip",
             meshed(rectangle(length, breadth), {make_circle({0.5 * length, 0.0}, radius, "rim")},
                    0.8, 1.0));
  const auto fields = final_fields(plate, {plate.load("tip", {force, 0.0})}, continuum(4, 1, 2));
  double largest = 0.0, crushed = 0.0;
  const StressField& field = fields.at(0).field;
  for (std::size_t k = 0; k < field.stresses.size(); ++k) {
    const double off = norm(field.drawn[k] - Vec2{0.5 * length, 0.0}) - radius;
    if (off > 1e-6) continue;
    largest = std::max(largest, principal_stress(field.stresses[k]).first);
    crushed = std::min(crushed, principal_stress(field.stresses[k]).second);
  }
  const double share = 1.0 - 2.0 * radius / breadth;
  const double factor = (2.0 + share * share * share) / share;
  note_measured("concentration", largest * breadth / force / factor - 1.0);
  note_measured("crushed", crushed * breadth / force);
  note_measured("stress_error", stress_error(fields).value());
  EXPECT_NEAR(largest * breadth / force, factor, 0.02 * factor);
  EXPECT_NEAR(crushed * breadth / force, -1.0, 0.2);  // -1 in an endless plate
}

TEST(ContinuumOutline, VibratesAsTheStrip) {
  Mechanism link;
  link.material(1000.0, 0.0).section(RectangleSection{1.0, 1.0}).fixed("ground").body("tip");
  Mechanism strip = link;
  link.link("ground", "tip", meshed(rectangle(10.0, 1.0), {}, 0.25, 1.0)).density(2.0);
  strip.flexure("ground", "tip", LineAxis{{0.0, 0.0}, {10.0, 0.0}}).density(2.0);
  const auto found = frequencies(link, continuum(12, 1, 6), 6);
  const auto truth = frequencies(strip, continuum(12, 1, 6), 6);
  double off = 0.0;
  for (std::size_t k = 0; k < 6; ++k) off = std::max(off, std::abs(found[k] / truth[k] - 1.0));
  note_measured("difference", off);
  EXPECT_LT(off, 4e-4);
}

/// Hinged at both ends, the far one sliding along: w = (n pi/L)^2 sqrt(EI/(rho A)) of Euler and
/// Bernoulli's beam, which a slender bar is to the square of its slenderness.
TEST(ContinuumOutline, HingedBarVibratesAsInClosedForm) {
  constexpr double length = 40.0, height = 0.5, modulus = 1000.0, density = 2.0;
  Mechanism bar;
  bar.material(modulus, 0.0).section(RectangleSection{1.0, 1.0}).fixed("ground").body("slider");
  bar.slide("ground", "slider", {1.0, 0.0});
  bar.link("ground", "slider", meshed(rectangle(length, height), {}, 0.25, 1.0)).density(density);
  bar.pin_base().pin_action();
  const auto found = frequencies(bar, continuum(12, 1, 6), 3);
  for (int n = 1; n <= 3; ++n) {
    const double truth =
        std::pow(n * pi / length, 2) * std::sqrt(modulus * height * height / 12.0 / density);
    const double off = found.at(static_cast<std::size_t>(n) - 1) / truth - 1.0;
    note_measured("mode_" + std::to_string(n), off);
    EXPECT_NEAR(off, 0.0, 4e-4 * n * n);
  }
}

}  // namespace
}  // namespace flexura::testing

// Outlines: their faults, and what their meshes must be.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "flexura/geometry/outline_mesh.hpp"

namespace flexura {
namespace {

constexpr double pi = std::numbers::pi;

OutlineLoop loop_of(const std::vector<OutlineStep>& steps) {
  std::string fault;
  OutlineLoop loop = make_loop(steps, fault);
  EXPECT_EQ(fault, "");
  return loop;
}

/// 40 by 10 with a rounded end, a fillet of 2 at its lower left corner and a hole of radius 2.
Outline arm() {
  Outline outline;
  outline.loops.push_back(loop_of({{{0.0, -5.0}, 0.0, 2.0, ""},
                                   {{40.0, -5.0}, 0.0, 0.0, ""},
                                   {{40.0, 5.0}, pi, 0.0, "nose"},
                                   {{0.0, 5.0}, 0.0, 0.0, ""}}));
  outline.loops[0][0].name = "clamp";  // the side to the first corner
  outline.loops.push_back(make_circle({38.0, 0.0}, 2.0, "eye"));
  return outline;
}
double arm_area() { return 400.0 + 12.5 * pi - 4.0 * (1.0 - 0.25 * pi) - 4.0 * pi; }

MeshLink link_of(const OutlineMesh& made, const char* base, const char* action) {
  MeshLink link;
  link.mesh = made.mesh;
  link.base = made.named.at(base);
  link.action = made.named.at(action);
  link.depth = 1.0;
  return link;
}

/// Least sine of a corner's angle, over all quadrilaterals.
double least_sine(const PlaneMesh& mesh) {
  double least = 1.0;
  for (const PlaneMesh::Element& element : mesh.elements)
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec2 ahead = mesh.place(element, (k + 1) % 4) - mesh.place(element, k);
      const Vec2 behind = mesh.place(element, (k + 3) % 4) - mesh.place(element, k);
      least = std::min(least, cross(ahead, behind) / (norm(ahead) * norm(behind)));
    }
  return least;
}

class OutlineMeshes : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Orders, OutlineMeshes, ::testing::Values(1, 2));

TEST_P(OutlineMeshes, CoverTheOutline) {
  Outline outline = arm();
  EXPECT_FALSE(find_outline_fault(outline).has_value());
  orient(outline);
  for (const double size : {4.0, 1.5, 0.5}) {
    const OutlineMesh made = mesh_outline(outline, size, GetParam());
    const MeshLink link = link_of(made, "clamp", "eye");
    const auto fault = find_mesh_fault(link);
    EXPECT_FALSE(fault.has_value()) << fault.value_or("");
    // four nodes cut arcs: by 15 degrees a side, less where that is longer than the size
    const double off = GetParam() == 1 ? 3e-3 : 2e-5;
    EXPECT_NEAR(mesh_area(made.mesh), arm_area(), off * arm_area());
    EXPECT_NEAR(expected_elements(outline, 1.0), arm_area(), 1e-9);
    EXPECT_GT(least_sine(made.mesh), GetParam() == 1 ? 0.25 : 0.3) << size;
    for (const std::size_t n : link.action)
      EXPECT_NEAR(norm(made.mesh.nodes[n] - Vec2{38.0, 0.0}), 2.0, 1e-12);
    for (const std::size_t n : made.named.at("nose"))
      EXPECT_NEAR(norm(made.mesh.nodes[n] - Vec2{40.0, 0.0}), 5.0, 1e-12);
    for (const std::size_t n : link.base) EXPECT_NEAR(made.mesh.nodes[n].x, 0.0, 1e-12);
    if (size < 1.0) {
      const double expected = expected_elements(outline, size);
      EXPECT_GT(static_cast<double>(made.mesh.elements.size()), 0.7 * expected);
      EXPECT_LT(static_cast<double>(made.mesh.elements.size()), 3.0 * expected);
    }
  }
}

/// Whichever way round and from whichever corner it is drawn.
TEST(OutlineMesh, DoesNotAskWhichWayRoundALineGoes) {
  Outline outline = arm();
  for (OutlineLoop& loop : outline.loops) {
    std::reverse(loop.begin(), loop.end());
    for (OutlineSide& side : loop) side = side.reversed();
  }
  EXPECT_FALSE(find_outline_fault(outline).has_value());
  orient(outline);
  EXPECT_NEAR(mesh_area(mesh_outline(outline, 2.0, 2).mesh), arm_area(), 1e-4 * arm_area());
}

/// A neck a twentieth of the size wide has two elements across at least.
TEST(OutlineMesh, IsFineWhereTheOutlineIsThin) {
  Outline outline;
  outline.loops.push_back(loop_of({{{-10.0, -5.0}, 0.0, 0.0, "left"},
                                   {{-3.0, -5.0}, 0.0, 0.0, ""},
                                   {{-3.0, -0.1}, 0.0, 0.0, ""},
                                   {{3.0, -0.1}, 0.0, 0.0, ""},
                                   {{3.0, -5.0}, 0.0, 0.0, ""},
                                   {{10.0, -5.0}, 0.0, 0.0, ""},
                                   {{10.0, 5.0}, 0.0, 0.0, "right"},
                                   {{3.0, 5.0}, 0.0, 0.0, ""},
                                   {{3.0, 0.1}, 0.0, 0.0, ""},
                                   {{-3.0, 0.1}, 0.0, 0.0, ""},
                                   {{-3.0, 5.0}, 0.0, 0.0, ""},
                                   {{-10.0, 5.0}, 0.0, 0.0, "left"}}));
  EXPECT_FALSE(find_outline_fault(outline).has_value());
  orient(outline);
  const OutlineMesh made = mesh_outline(outline, 4.0, 2);
  const double area = 140.0 + 1.2;
  EXPECT_NEAR(mesh_area(made.mesh), area, 1e-9 * area);
  EXPECT_GT(least_sine(made.mesh), 0.25);
  std::set<double> heights;
  for (const Vec2 node : made.mesh.nodes)
    if (std::abs(node.x) < 2.0) heights.insert(std::round(node.y * 1e6));
  EXPECT_GE(heights.size(), 5U);
  EXPECT_FALSE(find_mesh_fault(link_of(made, "left", "right")).has_value());
}

/// Polygons of any shape about a hole, corners as sharp as ten degrees among them.
TEST(OutlineMesh, CoversOutlinesOfChance) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> radius(3.0, 10.0), shift(-0.3, 0.3);
  for (int trial = 0; trial < 200; ++trial) {
    const int corners = 3 + trial % 9;
    std::vector<OutlineStep> steps;
    double twice = 0.0;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2.0 * pi * (k + shift(random)) / corners;
      steps.push_back({radius(random) * unit(angle), 0.0, 0.0, "rim"});
    }
    for (int k = 0; k < corners; ++k)
      twice += cross(steps[static_cast<std::size_t>(k)].to,
                     steps[static_cast<std::size_t>((k + 1) % corners)].to);
    Outline outline;
    outline.loops.push_back(loop_of(steps));
    outline.loops.push_back(make_circle({}, 0.5, "eye"));
    if (find_outline_fault(outline)) continue;  // the hole may stand out of a narrow one
    orient(outline);
    const OutlineMesh made = mesh_outline(outline, 1.0, 2);
    const double area = 0.5 * twice - 0.25 * pi;
    ASSERT_NEAR(mesh_area(made.mesh), area, 1e-4 * area) << trial;
    const auto fault = find_mesh_fault(link_of(made, "rim", "eye"));
    EXPECT_FALSE(fault.has_value()) << trial << ": " << fault.value_or("");
  }
}

TEST(OutlineFaults, SayWhere) {
  const auto fault_of = [](const std::vector<Vec2>& corners,
                           const std::vector<OutlineLoop>& holes) {
    std::vector<OutlineStep> border;
    for (const Vec2 corner : corners) border.push_back({corner, 0.0, 0.0, ""});
    Outline outline;
    outline.loops.push_back(loop_of(border));
    outline.loops.insert(outline.loops.end(), holes.begin(), holes.end());
    return find_outline_fault(outline).value_or("");
  };
  const std::vector<Vec2> square = {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {0.0, 10.0}};
  EXPECT_EQ(fault_of(square, {make_circle({5.0, 5.0}, 2.0, "")}), "");
  EXPECT_NE(fault_of({{0.0, 0.0}, {10.0, 10.0}, {10.0, 0.0}, {0.0, 10.0}}, {})
                .find("the border crosses itself near [5, 5]"),
            std::string::npos);
  EXPECT_NE(fault_of({{0.0, 0.0}, {10.0, 0.0}, {5.0, 0.0}, {5.0, 5.0}}, {})
                .find("the border crosses itself"),
            std::string::npos);
  EXPECT_NE(
      fault_of(square, {make_circle({20.0, 5.0}, 2.0, "")}).find("hole 1, at [22, 5], is not"),
      std::string::npos);
  EXPECT_NE(fault_of(square, {make_circle({9.0, 5.0}, 2.0, "")}).find("hole 1 meets the border"),
            std::string::npos);
  EXPECT_NE(fault_of(square, {make_circle({5.0, 5.0}, 3.0, ""), make_circle({5.0, 5.0}, 1.0, "")})
                .find("hole 2 is inside hole 1"),
            std::string::npos);
}

}  // namespace
}  // namespace flexura

// Flexures given by their outline.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/io/model_text.hpp"

namespace flexura::testing {
namespace {

constexpr double pi = std::numbers::pi;

std::string with_outline(const std::string& outline) {
  return "flexura = 1\n[units]\nlength = \"mm\"\nforce = \"N\"\ntime = \"s\"\n"
         "[parameters]\nr = 2\n"
         "[materials.steel]\nyoungs_modulus = 210e3\npoissons_ratio = 0.3\n"
         "[bodies.ground]\nfixed = true\n[bodies.stage]\n"
         "[flexures.arm]\nbetween = [\"ground\", \"stage\"]\nmaterial = \"steel\"\n"
         "[flexures.arm.outline]\n" +
         outline;
}

/// Units, parameters, arcs, fillets, holes of both kinds; a name on two sides is one edge.
TEST(OutlineReading, KnowsAllKeys) {
  const Model model = read_valid(with_outline(R"(
border = [
  { to = [0, 0], edge = "clamp" },
  { to = ["4 cm", 0], fillet = "= r" },
  { to = [40, 10], edge = "tip" },
  [26, 10],
  { to = [18, 10], sweep = "-180 deg" },
  [0, 10],
  { to = [0, 5], edge = "clamp" },
]
holes = [
  { centre = [5, 5], radius = "= r/2" },
  { border = [[10, 4], [12, 4], { to = [12, 6], edge = "slot" }, [10, 6]] },
]
base = "clamp"
action = "tip"
depth = 3
size = 1.5
order = 1
)"));
  ASSERT_EQ(model.flexures.size(), 1U);
  ASSERT_TRUE(model.flexures[0].link);
  const MeshLink& link = *model.flexures[0].link;
  EXPECT_EQ(link.depth, 3.0);
  EXPECT_EQ(link.mesh.elements.front().kind, ElementKind::quad4);
  const double area = 400.0 - 8.0 * pi - 4.0 * (1.0 - 0.25 * pi) - pi - 4.0;
  EXPECT_NEAR(mesh_area(link.mesh), area, 1e-2 * area);
  for (const std::size_t n : link.base) EXPECT_NEAR(link.mesh.nodes[n].x, 0.0, 1e-12);
  for (const std::size_t n : link.action) EXPECT_NEAR(link.mesh.nodes[n].x, 40.0, 1e-12);
  double low = 10.0, high = 0.0;
  for (const std::size_t n : link.base) {
    low = std::min(low, link.mesh.nodes[n].y);
    high = std::max(high, link.mesh.nodes[n].y);
  }
  EXPECT_EQ(low, 0.0);
  EXPECT_EQ(high, 10.0);
  EXPECT_TRUE(std::holds_alternative<LineAxis>(model.flexures[0].axis));
}

TEST(OutlineReading, IsOfEightNodesByDefault) {
  const Model model = read_valid(with_outline(
      "border = [[0, 0], [9, 0], { to = [9, 3], edge = \"b\" }, [0, 3]]\nbase = \"a\"\n"
      "action = \"b\"\ndepth = 1\nsize = 1\nholes = [{ centre = [2, 1.5], radius = 1, edge = "
      "\"a\" }]\n"));
  const MeshLink& link = *model.flexures.at(0).link;
  EXPECT_EQ(link.mesh.elements.front().kind, ElementKind::quad8);
  for (const std::size_t n : link.base)
    EXPECT_NEAR(norm(link.mesh.nodes[n] - Vec2{2.0, 1.5}), 1.0, 1e-12);
}

}  // namespace
}  // namespace flexura::testing

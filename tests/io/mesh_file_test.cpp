// Mesh files of Gmsh and Abaqus.
#include "flexura/io/mesh_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace flexura {
namespace {

/// Two 4-node quadrilaterals and a triangle on top of the second.
const char* const in_gmsh_4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
1 1 "the left"
2 3 "plate"
$EndPhysicalNames
$Entities
1 2 1 0
1 0 0 0 0
1 0 0 0 0 1 0 1 -1 0
2 2 0 0 2 1 0 1 7 2 1 -1
1 0 0 0 2 2 0 1 3 0
$EndEntities
$Nodes
2 7 1 7
1 1 0 2
1
6
0 0 0
0 1 0
2 1 0 5
2
3
4
5
7
1 0 0
2 0 0
2 1 0
1 1 0
1.5 2 0
$EndNodes
$Elements
4 5 1 5
1 1 1 1
1 6 1
1 2 1 1
2 3 4
2 1 3 2
3 1 2 5 6
4 2 3 4 5
2 1 2 1
5 5 4 7
$EndElements
)";

const char* const in_abaqus = R"(** by hand
*Node
1, 0., 0., 0.
2, 1., 0., 0.
3, 2., 0., 0.
4, 2., 1., 0.
5, 1., 1., 0.
6, 0., 1., 0.
7, 1.5, 2., 0.
*Element, type=CPS4R, elset=Quads
3, 1, 2,
 5, 6
4, 2, 3, 4, 5
*Element, type=CPS3, elset=top
5, 5, 4, 7
*Nset, nset="the left", generate
1, 6, 5
*Elset, elset=plate
quads, TOP
*Surface, type=ELEMENT, name=7
4, S2
*Material, name=anything
*Elastic
1., 0.3
)";

const MeshGroup& group(const MeshFileReading& file, const std::string& name) {
  const auto found = std::find_if(file.groups.begin(), file.groups.end(),
                                  [&](const MeshGroup& g) { return g.name == name; });
  if (found == file.groups.end()) throw std::runtime_error("no group " + name);
  return *found;
}

void expect_same_mesh(const MeshFileReading& file) {
  ASSERT_EQ(file.error, "");
  ASSERT_EQ(file.mesh.elements.size(), 3u);
  EXPECT_NEAR(mesh_area(file.mesh), 2.5, 1e-14);
  EXPECT_EQ(group(file, "plate").elements.size(), 3u);
  EXPECT_EQ(file.mesh.elements[2].kind, ElementKind::triangle3);
  EXPECT_EQ(file.mesh.elements[2].label, 5);
  for (const auto& [name, x] : {std::pair{"the left", 0.0}, std::pair{"7", 2.0}}) {
    std::set<double> heights;
    for (const std::size_t n : group(file, name).nodes) {
      EXPECT_EQ(file.mesh.nodes[n].x, x) << name;
      heights.insert(file.mesh.nodes[n].y);
    }
    EXPECT_EQ(heights, (std::set<double>{0.0, 1.0})) << name;
  }
}

TEST(MeshFile, IsReadFromGmsh) { expect_same_mesh(read_gmsh(in_gmsh_4, "a.msh")); }
TEST(MeshFile, IsReadFromAbaqus) { expect_same_mesh(read_abaqus(in_abaqus, "a.inp")); }

/// However a file is cut off or spoilt, it is read or refused in words.
TEST(MeshFile, NeverSurprises) {
  for (const char* whole : {in_gmsh_4, in_abaqus}) {
    const std::string text = whole;
    for (std::size_t n = 0; n < text.size(); n += 3) {
      for (const std::string& spoilt :
           {text.substr(0, n), text.substr(0, n) + "-9" + text.substr(n),
            text.substr(0, n) + text.substr(n + 1)}) {
        const MeshFileReading read =
            whole == in_gmsh_4 ? read_gmsh(spoilt, "a.msh") : read_abaqus(spoilt, "a.inp");
        MeshLink link{read.mesh, {}, {}, 1.0};
        if (!read.groups.empty()) link.base = link.action = read.groups.front().nodes;
        EXPECT_TRUE(!read.error.empty() || find_mesh_fault(link).has_value());
      }
    }
  }
}

/// Middles of sides go along when a clockwise mesh is turned round.
TEST(MeshFile, MayBeClockwise) {
  PlaneMesh mesh;
  mesh.nodes = {{0, 0}, {0, 2}, {2, 2}, {2, 0}, {0, 1}, {1, 2}, {2, 1}, {1, 0}};
  mesh.add(ElementKind::quad8, {0, 1, 2, 3, 4, 5, 6, 7}, 1);
  EXPECT_NEAR(mesh_area(mesh), -4.0, 1e-13);
  turn_clockwise_mesh(mesh);
  EXPECT_NEAR(mesh_area(mesh), 4.0, 1e-13);
}

/// Round a hole by a bridge and back.
TEST(MeshFile, HasABorderThatGoesRoundHoles) {
  MeshLink link;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) link.mesh.nodes.push_back({1.0 * i, 1.0 * j});
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t i = 0; i < 3; ++i)
      if (i != 1 || j != 1)
        link.mesh.add(ElementKind::quad4, {4 * j + i, 4 * j + i + 1, 4 * j + i + 5, 4 * j + i + 4},
                      1);
  const std::vector<std::size_t> border = border_of(link.mesh);
  EXPECT_EQ(border.size(), 13u + 6u);  // 12 sides outside, 4 inside, the bridge twice
  EXPECT_EQ(border.front(), border.back());
}

}  // namespace
}  // namespace flexura

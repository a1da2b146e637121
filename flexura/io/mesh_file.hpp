#pragma once

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "flexura/geometry/mesh_link.hpp"

namespace flexura {

/// No mesh file is longer (bytes).
inline constexpr std::size_t longest_mesh_file = std::size_t{256} << 20U;

/// A named part of a mesh: an edge, a hole's rim, a surface, a set.
struct MeshGroup {
  std::string name;
  std::vector<std::size_t> nodes;     ///< may repeat
  std::vector<std::size_t> elements;  ///< of the mesh
};

/// What a mesh file says, or what is wrong: "file:line: message".
struct MeshFileReading {
  PlaneMesh mesh;
  std::vector<MeshGroup> groups;
  std::string error;
};

/// A `.msh` file of Gmsh or an `.inp` file of Abaqus; `shown` is its name as the user wrote it.
MeshFileReading read_mesh_file(const std::filesystem::path& path, const std::string& shown);

/// MSH 4.1 and 2.2, ASCII. Groups are the physical ones, by their name or else their number.
MeshFileReading read_gmsh(std::string_view text, const std::string& shown);

/// Groups are node sets, element sets and surfaces.
MeshFileReading read_abaqus(std::string_view text, const std::string& shown);

/// What stops a reader of meshes: the line it is in and what is wrong there.
struct MeshMistake : std::runtime_error {
  MeshMistake(std::size_t at, const std::string& what) : std::runtime_error(what), line(at) {}
  std::size_t line;
};

/// Puts together what a mesh file says piece by piece. Throws MeshMistake.
class MeshBuilder {
 public:
  void add_node(long label, Vec2 place, double z, std::size_t line);
  std::size_t node(long label, std::size_t line) const;
  /// Nodes by their labels. Elements along lines, and points, only belong to groups.
  void add_element(ElementKind kind, long label, const std::vector<long>& nodes, std::size_t line);
  void add_line(long label, const std::vector<long>& nodes, std::size_t line);
  /// Mesh nodes of an element.
  const std::vector<std::size_t>& element_nodes(long label, std::size_t line) const;
  /// Of an element of the mesh, by its place there.
  long label_of(std::size_t element) const { return result_.mesh.elements[element].label; }
  /// The group of that name, new if there is none.
  MeshGroup& group(const std::string& name);
  void put_in_group(const std::string& name, long element, std::size_t line);

  MeshFileReading take() && { return std::move(result_); }

 private:
  void keep(long label, const std::vector<long>& nodes, std::size_t line);

  MeshFileReading result_;
  std::unordered_map<long, std::size_t> node_of_;
  std::unordered_map<long, std::vector<std::size_t>> nodes_of_;
  std::unordered_map<long, std::size_t> element_of_;
  std::map<std::string, std::size_t> index_;
  double z_ = 0.0;
};

}  // namespace flexura

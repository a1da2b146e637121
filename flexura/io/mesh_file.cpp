#include "flexura/io/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flexura/io/text_file.hpp"

namespace flexura {

void MeshBuilder::add_node(long label, Vec2 place, double z, std::size_t line) {
  if (!std::isfinite(place.x) || !std::isfinite(place.y))
    throw MeshMistake(line, fmt::format("node {} is nowhere", label));
  if (!node_of_.emplace(label, result_.mesh.nodes.size()).second)
    throw MeshMistake(line, fmt::format("node {} is there twice", label));
  if (result_.mesh.nodes.empty()) z_ = z;
  const double size = std::max({norm(place), std::abs(z_), 1e-300});
  if (std::abs(z - z_) > 1e-6 * size)
    throw MeshMistake(line, fmt::format("node {} lies off the plane z = {} of those before it, at "
                                        "{}; links are plane",
                                        label, z_, z));
  result_.mesh.nodes.push_back(place);
}

std::size_t MeshBuilder::node(long label, std::size_t line) const {
  const auto found = node_of_.find(label);
  if (found == node_of_.end()) throw MeshMistake(line, fmt::format("there is no node {}", label));
  return found->second;
}

void MeshBuilder::keep(long label, const std::vector<long>& nodes, std::size_t line) {
  std::vector<std::size_t> own;
  own.reserve(nodes.size());
  for (const long n : nodes) own.push_back(node(n, line));
  if (!nodes_of_.emplace(label, std::move(own)).second)
    throw MeshMistake(line, fmt::format("element {} is there twice", label));
}

void MeshBuilder::add_element(ElementKind kind, long label, const std::vector<long>& nodes,
                              std::size_t line) {
  keep(label, nodes, line);
  element_of_.emplace(label, result_.mesh.elements.size());
  result_.mesh.add(kind, nodes_of_.at(label), label);
}

void MeshBuilder::add_line(long label, const std::vector<long>& nodes, std::size_t line) {
  keep(label, nodes, line);
}

const std::vector<std::size_t>& MeshBuilder::element_nodes(long label, std::size_t line) const {
  const auto found = nodes_of_.find(label);
  if (found == nodes_of_.end())
    throw MeshMistake(line, fmt::format("there is no element {}", label));
  return found->second;
}

MeshGroup& MeshBuilder::group(const std::string& name) {
  const auto [at, is_new] = index_.try_emplace(name, result_.groups.size());
  if (is_new) result_.groups.push_back({name, {}, {}});
  return result_.groups[at->second];
}

void MeshBuilder::put_in_group(const std::string& name, long element, std::size_t line) {
  const std::vector<std::size_t>& nodes = element_nodes(element, line);
  MeshGroup& own = group(name);
  own.nodes.insert(own.nodes.end(), nodes.begin(), nodes.end());
  const auto found = element_of_.find(element);
  if (found != element_of_.end()) own.elements.push_back(found->second);
}

MeshFileReading read_mesh_file(const std::filesystem::path& path, const std::string& shown) {
  const auto refuse = [](std::string error) { return MeshFileReading{{}, {}, std::move(error)}; };
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension != ".msh" && extension != ".inp")
    return refuse(
        fmt::format("'{}' is neither a .msh file of Gmsh nor an .inp file of Abaqus", shown));
  const TextReading file = read_text_file(path, shown, longest_mesh_file);
  if (!file.error.empty()) return refuse(file.error);
  return extension == ".msh" ? read_gmsh(file.text, shown) : read_abaqus(file.text, shown);
}

}  // namespace flexura

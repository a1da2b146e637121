// The readers of meshes: an input whose first byte is odd is a file of Abaqus, else of Gmsh.
#include "flexura/io/mesh_file.hpp"
#include "fuzz/target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flexura;
  if (size == 0) return 0;
  const std::string_view text = fuzz::text_of(data, size);
  const bool abaqus = text.starts_with("*") || (data[0] & 1U) != 0;
  const MeshFileReading reading = abaqus ? read_abaqus(text, "m.inp") : read_gmsh(text, "m.msh");
  if (!reading.error.empty()) return 0;
  for (const MeshGroup& group : reading.groups) {
    for (const std::size_t node : group.nodes) fuzz::expect(node < reading.mesh.nodes.size());
    for (const std::size_t element : group.elements)
      fuzz::expect(element < reading.mesh.elements.size());
  }
  return 0;
}

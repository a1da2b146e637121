#include "flexura/io/write_vtu.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "flexura/io/base64.hpp"

namespace flexura {
namespace {

constexpr std::uint8_t vtk_triangle = 5;
constexpr std::uint8_t vtk_quad = 9;

/// What the grid has of every node, flexure by flexure.
template <class Visit>
void for_nodes(const FieldState& fields, const Visit& visit) {
  for (const auto& [flexure, field] : fields.flexures)
    for (std::size_t k = 0; k < field.stresses.size(); ++k) visit(field, k);
}

/// Likewise of every piece: `first` is the number of its flexure's first node.
template <class Visit>
void for_pieces(const FieldState& fields, const Visit& visit) {
  std::size_t first = 0;
  for (const auto& [flexure, field] : fields.flexures) {
    field.for_pieces([&, index = flexure, &of = field](const StressField::Piece& piece) {
      visit(index, of, first, piece);
    });
    first += field.stresses.size();
  }
}

template <class Number>
const char* type_name() {
  if constexpr (std::is_same_v<Number, double>) return "Float64";
  if constexpr (std::is_same_v<Number, std::int32_t>) return "Int32";
  return "UInt8";
}

/// Arrays whose numbers stand behind the grid, each after the count of its bytes.
class AppendedArrays {
 public:
  /// The array's element of the grid.
  template <class Number>
  std::string add(const char* name, const std::string& components,
                  const std::vector<Number>& values) {
    std::string element =
        fmt::format(R"(        <DataArray type="{}" Name="{}"{} format="appended" offset="{}"/>)",
                    type_name<Number>(), name, components, data_.size());
    const std::uint64_t size = values.size() * sizeof(Number);
    std::vector<unsigned char> bytes(sizeof size + size);
    std::memcpy(bytes.data(), &size, sizeof size);
    if (size > 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
    append_base64(bytes, data_);
    return element + "\n";
  }
  const std::string& data() const { return data_; }

 private:
  std::string data_;
};

std::string named_components(const std::vector<const char*>& names) {
  std::string text = fmt::format(R"( NumberOfComponents="{}")", names.size());
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format(R"( ComponentName{}="{}")", i, names[i]);
  return text;
}

template <class Values>
std::vector<double> node_values(const FieldState& fields, const Values& values_of) {
  std::vector<double> all;
  for_nodes(fields, [&](const StressField& field, std::size_t k) {
    for (const double value : values_of(field, k)) all.push_back(value);
  });
  return all;
}

std::string point_data(const FieldState& fields, AppendedArrays& arrays) {
  std::string text = "      <PointData Scalars=\"von_mises\" Vectors=\"displacement\">\n";
  text += arrays.add("displacement", R"( NumberOfComponents="3")",
                     node_values(fields, [](const StressField& field, std::size_t k) {
                       const Vec2 u = field.places[k] - field.drawn[k];
                       return std::array{u.x, u.y, 0.0};
                     }));
  text += arrays.add("stress", named_components({"xx", "yy", "xy"}),
                     node_values(fields, [](const StressField& field, std::size_t k) {
                       const PlaneStress& s = field.stresses[k];
                       return std::array{s.xx, s.yy, s.xy};
                     }));
  text += arrays.add("principal", named_components({"first", "second", "angle"}),
                     node_values(fields, [](const StressField& field, std::size_t k) {
                       const PrincipalStress p = principal_stress(field.stresses[k]);
                       return std::array{p.first, p.second, p.angle};
                     }));
  text +=
      arrays.add("von_mises", "", node_values(fields, [](const StressField& field, std::size_t k) {
                   return std::array{von_mises_stress(field.stresses[k])};
                 }));
  return text + "      </PointData>\n";
}

std::string cell_data(const FieldState& fields, AppendedArrays& arrays) {
  double energy = 0.0;
  for (const auto& [flexure, field] : fields.flexures) energy += field.energy;
  std::vector<std::int32_t> flexures;
  std::vector<double> errors;
  for_pieces(fields, [&](std::size_t flexure, const StressField& field, std::size_t /*first*/,
                         const StressField::Piece& piece) {
    flexures.push_back(static_cast<std::int32_t>(flexure));
    const double error = field.error_energies[piece.element];
    errors.push_back(energy > 0.0 ? std::sqrt(error / energy) : 0.0);
  });
  std::string text = "      <CellData>\n";
  text += arrays.add("flexure", "", flexures);
  text += arrays.add("error", "", errors);
  return text + "      </CellData>\n";
}

std::string grid(const FieldState& fields, AppendedArrays& arrays) {
  std::string text = "      <Points>\n";
  text += arrays.add("points", R"( NumberOfComponents="3")",
                     node_values(fields, [](const StressField& field, std::size_t k) {
                       return std::array{field.drawn[k].x, field.drawn[k].y, 0.0};
                     }));
  text += "      </Points>\n      <Cells>\n";
  std::vector<std::int32_t> corners;
  std::vector<std::int32_t> ends;
  std::vector<std::uint8_t> types;
  for_pieces(fields, [&](std::size_t /*flexure*/, const StressField& /*field*/, std::size_t first,
                         const StressField::Piece& piece) {
    for (std::size_t k = 0; k < piece.corners; ++k)
      corners.push_back(static_cast<std::int32_t>(first + piece.nodes[k]));
    ends.push_back(static_cast<std::int32_t>(corners.size()));
    types.push_back(piece.corners == 3 ? vtk_triangle : vtk_quad);
  });
  text += arrays.add("connectivity", "", corners);
  text += arrays.add("offsets", "", ends);
  text += arrays.add("types", "", types);
  return text + "      </Cells>\n";
}

constexpr const char* byte_order =
    std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";

/// Markup's own characters in a file's name.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

}  // namespace

std::string make_vtu(const FieldState& fields, double time) {
  std::size_t points = 0;
  std::size_t cells = 0;
  for (const auto& [flexure, field] : fields.flexures) {
    points += field.stresses.size();
    field.for_pieces([&](const StressField::Piece& /*piece*/) { ++cells; });
  }
  AppendedArrays arrays;
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" "
      "header_type=\"UInt64\">\n"
      "  <UnstructuredGrid>\n"
      "    <FieldData>\n"
      "      <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
      "format=\"ascii\">{}</DataArray>\n"
      "    </FieldData>\n"
      "    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
      byte_order, time, points, cells);
  text += point_data(fields, arrays);
  text += cell_data(fields, arrays);
  text += grid(fields, arrays);
  text += "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"base64\">\n_";
  text += arrays.data();
  return text + "\n  </AppendedData>\n</VTKFile>\n";
}

std::string make_pvd(const std::vector<std::string>& files, const std::vector<double>& times) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
      "byte_order=\"{}\">\n  <Collection>\n",
      byte_order);
  for (std::size_t k = 0; k < files.size(); ++k)
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", times[k],
                        escaped(files[k]));
  return text + "  </Collection>\n</VTKFile>\n";
}

}  // namespace flexura

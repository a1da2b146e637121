#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <utility>

#include "flexura/io/mesh_file.hpp"
#include "flexura/io/text_file.hpp"

namespace flexura {
namespace {

/// What stands between spaces, line after line; names in double quotes are one word.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  std::size_t line() const { return line_; }
  /// Empty at the end of the file.
  std::string_view next() {
    constexpr std::string_view spaces = " \t\r\n";
    while (at_ < text_.size() && spaces.find(text_[at_]) != std::string_view::npos)
      if (text_[at_++] == '\n') ++next_line_;
    line_ = next_line_;
    if (at_ == text_.size()) return {};
    const bool quoted = text_[at_] == '"';
    const std::size_t end =
        quoted ? text_.find_first_of("\"\n", at_ + 1) : text_.find_first_of(spaces, at_);
    const std::size_t start = at_;
    at_ = std::min(end, text_.size());
    if (quoted && at_ < text_.size() && text_[at_] == '"') ++at_;
    return text_.substr(start, at_ - start);
  }
  template <class Number>
  Number number(const char* what) {
    const std::string_view word = next();
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) {
      throw MeshMistake(line_, word.empty()
                                   ? fmt::format("the file ends before {}", what)
                                   : fmt::format("expected {}, got '{}'", what, shown_text(word)));
    }
    return value;
  }
  std::size_t count(const char* what) {
    const long n = number<long>(what);
    if (n < 0) throw MeshMistake(line_, fmt::format("expected {}, got {}", what, n));
    return static_cast<std::size_t>(n);
  }
  void skip_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    at_ = end;
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t next_line_ = 1;
};

struct GmshElement {
  std::size_t nodes;
  std::optional<ElementKind> kind;  ///< nothing: a line or a point
};

std::optional<GmshElement> element_of_type(long type) {
  switch (type) {
    case 1:
      return GmshElement{2, {}};
    case 8:
      return GmshElement{3, {}};
    case 15:
      return GmshElement{1, {}};
    case 2:
      return GmshElement{3, ElementKind::triangle3};
    case 3:
      return GmshElement{4, ElementKind::quad4};
    case 9:
      return GmshElement{6, ElementKind::triangle6};
    case 10:
      return GmshElement{9, ElementKind::quad9};
    case 16:
      return GmshElement{8, ElementKind::quad8};
    default:
      return {};
  }
}

class GmshReader {
 public:
  explicit GmshReader(std::string_view text) : words_(text) {}

  MeshFileReading read() {
    for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
      if (word == "$MeshFormat") read_format();
      if (word == "$PhysicalNames") read_names();
      if (word == "$Entities") read_entities();
      if (word == "$Nodes") old_ ? read_old_nodes() : read_nodes();
      if (word == "$Elements") old_ ? read_old_elements() : read_elements();
      if (!formatted_) throw MeshMistake(words_.line(), "a mesh of Gmsh begins with $MeshFormat");
    }
    if (!formatted_) throw MeshMistake(1, "the file is empty");
    return std::move(builder_).take();
  }

 private:
  void read_format() {
    const std::string version(words_.next());
    const std::size_t line = words_.line();
    if (version != "4.1" && version != "2.2")
      throw MeshMistake(line, fmt::format("format '{}' is not read; 4.1 and 2.2 are (gmsh -format "
                                          "msh41)",
                                          shown_text(version)));
    if (words_.number<long>("0, for ASCII") != 0)
      throw MeshMistake(line, "the mesh is binary; save it as ASCII");
    old_ = version == "2.2";
    formatted_ = true;
  }

  void read_names() {
    const std::size_t names = words_.count("the number of names");
    for (std::size_t k = 0; k < names; ++k) {
      const int dimension = words_.number<int>("a dimension");
      const long tag = words_.number<long>("the number of a physical group");
      std::string_view name = words_.next();
      if (name.size() < 2 || name.front() != '"' || name.back() != '"')
        throw MeshMistake(words_.line(), "expected a name in double quotes");
      names_[{dimension, tag}] = name.substr(1, name.size() - 2);
    }
  }

  void read_entities() {
    std::size_t counts[4];
    for (std::size_t& count : counts) count = words_.count("the number of entities");
    for (int dimension = 0; dimension < 4; ++dimension)
      for (std::size_t k = 0; k < counts[dimension]; ++k) {
        const long tag = words_.number<long>("the number of an entity");
        for (int i = 0; i < (dimension == 0 ? 3 : 6); ++i) words_.number<double>("a coordinate");
        const std::size_t groups = words_.count("the number of physical groups");
        for (std::size_t g = 0; g < groups; ++g) {
          const long group = words_.number<long>("a physical group");
          // a curve that runs against its group has a negative one
          groups_[{dimension, tag}].push_back(group < 0 ? -group : group);
        }
        words_.skip_line();
      }
  }

  void read_nodes() {
    const std::size_t blocks = words_.count("the number of blocks of nodes");
    for (int i = 0; i < 3; ++i) words_.number<long>("a number of nodes");
    for (std::size_t b = 0; b < blocks; ++b) {
      for (int i = 0; i < 3; ++i) words_.number<long>("an entity");
      const std::size_t nodes = words_.count("the number of nodes in the block");
      std::vector<long> labels;
      for (std::size_t k = 0; k < nodes; ++k) labels.push_back(words_.number<long>("a node"));
      for (const long label : labels) read_place(label);
    }
  }

  void read_place(long label) {
    const double x = words_.number<double>("a coordinate");
    const double y = words_.number<double>("a coordinate");
    const double z = words_.number<double>("a coordinate");
    builder_.add_node(label, {x, y}, z, words_.line());
    words_.skip_line();  // parameters of the place on its curve
  }

  void read_elements() {
    const std::size_t blocks = words_.count("the number of blocks of elements");
    for (int i = 0; i < 3; ++i) words_.number<long>("a number of elements");
    for (std::size_t b = 0; b < blocks; ++b) {
      const int dimension = words_.number<int>("a dimension");
      const long entity = words_.number<long>("an entity");
      const long type = words_.number<long>("a type of elements");
      const std::size_t line = words_.line();
      const std::size_t count = words_.count("the number of elements in the block");
      for (std::size_t k = 0; k < count; ++k) {
        const long label = words_.number<long>("an element");
        read_element(type, label, line);
        for (const long group : groups_[{dimension, entity}]) put_in_group(dimension, group, label);
      }
    }
  }

  void read_old_nodes() {
    const std::size_t nodes = words_.count("the number of nodes");
    for (std::size_t k = 0; k < nodes; ++k) read_place(words_.number<long>("a node"));
  }

  void read_old_elements() {
    const std::size_t count = words_.count("the number of elements");
    for (std::size_t k = 0; k < count; ++k) {
      const long label = words_.number<long>("an element");
      const long type = words_.number<long>("a type of element");
      const std::size_t line = words_.line();
      const std::size_t tags = words_.count("the number of tags");
      long group = 0;
      for (std::size_t t = 0; t < tags; ++t) {
        const long tag = words_.number<long>("a tag");
        if (t == 0) group = tag < 0 ? -tag : tag;
      }
      const int dimension = read_element(type, label, line);
      if (group != 0) put_in_group(dimension, group, label);
    }
  }

  /// Its nodes; returns the dimension.
  int read_element(long type, long label, std::size_t line) {
    const auto element = element_of_type(type);
    if (!element)
      throw MeshMistake(line, fmt::format("element {} is of type {}: triangles of 3 and 6 nodes "
                                          "(types 2 and 9) and quadrilaterals of 4, 8 and 9 (3, 16 "
                                          "and 10) make a link, with lines (1 and 8) that name its "
                                          "edges",
                                          label, type));
    std::vector<long> nodes;
    for (std::size_t a = 0; a < element->nodes; ++a) nodes.push_back(words_.number<long>("a node"));
    if (element->kind) {
      builder_.add_element(*element->kind, label, nodes, words_.line());
      return 2;
    }
    builder_.add_line(label, nodes, words_.line());
    return element->nodes == 1 ? 0 : 1;
  }

  void put_in_group(int dimension, long group, long element) {
    const auto named = names_.find({dimension, group});
    builder_.put_in_group(named == names_.end() ? std::to_string(group) : named->second, element,
                          words_.line());
  }

  using Key = std::pair<int, long>;  // dimension and number
  Words words_;
  MeshBuilder builder_;
  std::map<Key, std::string> names_;
  std::map<Key, std::vector<long>> groups_;
  bool formatted_ = false;
  bool old_ = false;
};

}  // namespace

MeshFileReading read_gmsh(std::string_view text, const std::string& shown) {
  try {
    return GmshReader(text).read();
  } catch (const MeshMistake& mistake) {
    return {{}, {}, fmt::format("{}:{}: {}", shown, mistake.line, mistake.what())};
  }
}

}  // namespace flexura

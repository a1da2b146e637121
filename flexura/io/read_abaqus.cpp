#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "flexura/io/mesh_file.hpp"
#include "flexura/io/text_file.hpp"

namespace flexura {
namespace {

/// Abaqus does not tell small letters from large ones.
std::string large(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return result;
}

template <class Number>
std::optional<Number> number_in(std::string_view word) {
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return {};
  return value;
}

struct AbaqusElement {
  std::size_t nodes = 0;
  std::optional<ElementKind> kind = {};  ///< nothing: a line
};

/// CPS4R and the like, whatever follows the number of nodes; trusses and beams stand for edges.
std::optional<AbaqusElement> element_of_type(const std::string& type) {
  if (type.size() >= 4 && (type.starts_with("CPS") || type.starts_with("CPE"))) {
    const bool plain = type.find_first_not_of("RIHMT", 4) == std::string::npos;
    if (plain && type[3] == '3') return AbaqusElement{3, ElementKind::triangle3};
    if (plain && type[3] == '4') return AbaqusElement{4, ElementKind::quad4};
    if (plain && type[3] == '6') return AbaqusElement{6, ElementKind::triangle6};
    if (plain && type[3] == '8') return AbaqusElement{8, ElementKind::quad8};
  }
  if (type == "T2D2" || type == "T3D2" || type == "B21" || type == "B31") return AbaqusElement{2};
  if (type == "T2D3" || type == "T3D3" || type == "B22" || type == "B32") return AbaqusElement{3};
  return {};
}

class AbaqusReader {
 public:
  explicit AbaqusReader(std::string_view text) : text_(text) {}

  MeshFileReading read() {
    while (next_line()) {
      if (fields_.front().starts_with("*"))
        begin_keyword();
      else
        read_data();
    }
    if (!nodes_.empty() || pending_) fail("the file ends in the middle of an element");
    return std::move(builder_).take();
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw MeshMistake(line_, what); }

  /// The next line that is no comment, as its fields.
  bool next_line() {
    while (!text_.empty()) {
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      std::string_view line = trimmed(text_.substr(0, end));
      text_.remove_prefix(std::min(end + 1, text_.size()));
      ++line_;
      if (line.empty() || line.starts_with("**")) continue;
      fields_.clear();
      while (true) {
        const std::size_t comma = line.find(',');
        const std::string_view field = trimmed(line.substr(0, comma));
        if (comma == std::string_view::npos) {
          if (!field.empty()) fields_.push_back(field);
          break;
        }
        fields_.push_back(field);
        line.remove_prefix(comma + 1);
      }
      return true;
    }
    return false;
  }

  /// What a keyword's parameter says, in its own letters; empty if it is not there.
  std::string parameter(const char* name) const {
    for (std::size_t k = 1; k < fields_.size(); ++k) {
      const std::size_t equals = fields_[k].find('=');
      if (large(trimmed(fields_[k].substr(0, equals))) != name) continue;
      if (equals == std::string_view::npos) return "yes";
      std::string_view value = trimmed(fields_[k].substr(equals + 1));
      if (value.size() >= 2 && value.front() == '"' && value.back() == '"')
        value = value.substr(1, value.size() - 2);
      return std::string(value);
    }
    return {};
  }

  void begin_keyword() {
    if (pending_) fail("an element ends before its last node");
    keyword_ = large(trimmed(fields_.front().substr(1)));
    keyword_.erase(std::remove(keyword_.begin(), keyword_.end(), ' '), keyword_.end());
    set_.clear();
    generate_ = !parameter("GENERATE").empty();
    if (keyword_ == "INCLUDE") fail("files that include others are not read");
    if (keyword_ == "NODE" || keyword_ == "NSET") set_ = name_of(parameter("NSET"));
    if (keyword_ == "ELSET" || keyword_ == "ELEMENT") set_ = name_of(parameter("ELSET"));
    if (keyword_ == "SURFACE") {
      set_ = name_of(parameter("NAME"));
      of_nodes_ = large(parameter("TYPE")) == "NODE";
    }
    const bool needs_name = keyword_ == "NSET" || keyword_ == "ELSET" || keyword_ == "SURFACE";
    if (needs_name && set_.empty()) fail(fmt::format("this *{} has no name", keyword_));
    if (!set_.empty()) builder_.group(set_);
    if (keyword_ == "ELEMENT") begin_elements();
  }

  void begin_elements() {
    const std::string type = large(parameter("TYPE"));
    const auto element = element_of_type(type);
    if (!element)
      fail(
          fmt::format("elements of type '{}' are not read: CPS3, CPS4, CPS6, CPS8 and CPE likewise "
                      "make a link, and T2D2 and the like name its edges",
                      shown_text(type)));
    element_ = *element;
  }

  /// As the name was first written, whatever its letters.
  std::string name_of(const std::string& name) {
    return name.empty() ? name : names_.try_emplace(large(name), name).first->second;
  }

  long label(std::string_view field, const char* what) const {
    // sets of an assembly name the instance before the number
    const std::size_t dot = field.rfind('.');
    if (dot != std::string_view::npos) field.remove_prefix(dot + 1);
    const auto value = number_in<long>(field);
    if (!value) fail(fmt::format("expected {}, got '{}'", what, shown_text(field)));
    return *value;
  }

  void read_data() {
    if (keyword_ == "NODE") read_node();
    if (keyword_ == "ELEMENT") read_element();
    if (keyword_ == "NSET" || keyword_ == "ELSET") read_set();
    if (keyword_ == "SURFACE") read_surface();
    if (keyword_ == "INSTANCE") fail("instances that are moved are not read; write a flat file");
  }

  void read_node() {
    if (fields_.size() < 3) fail("a node has a number and two coordinates");
    double place[3] = {};
    const long node = label(fields_[0], "the number of a node");
    for (std::size_t k = 1; k < std::min<std::size_t>(fields_.size(), 4); ++k) {
      const auto value =
          number_in<double>(fields_[k].starts_with('+') ? fields_[k].substr(1) : fields_[k]);
      if (!value) fail(fmt::format("expected a coordinate, got '{}'", shown_text(fields_[k])));
      place[k - 1] = *value;
    }
    builder_.add_node(node, {place[0], place[1]}, place[2], line_);
    if (!set_.empty()) builder_.group(set_).nodes.push_back(builder_.node(node, line_));
  }

  /// The nodes of an element may go on in the next line.
  void read_element() {
    for (const std::string_view field : fields_) {
      if (field.empty()) continue;
      const long number = label(field, pending_ ? "the number of a node" : "that of an element");
      if (!pending_)
        pending_ = number;
      else
        nodes_.push_back(number);
      if (nodes_.size() < element_.nodes) continue;
      if (element_.kind)
        builder_.add_element(*element_.kind, *pending_, nodes_, line_);
      else
        builder_.add_line(*pending_, nodes_, line_);
      kinds_[*pending_] = element_;
      if (!set_.empty()) builder_.put_in_group(set_, *pending_, line_);
      pending_.reset();
      nodes_.clear();
    }
  }

  void read_set() {
    const bool of_nodes = keyword_ == "NSET";
    const auto put = [&](long number) {
      if (of_nodes)
        builder_.group(set_).nodes.push_back(builder_.node(number, line_));
      else
        builder_.put_in_group(set_, number, line_);
    };
    if (generate_) {
      if (fields_.size() < 2) fail("a generated set has a first and a last number");
      const long first = label(fields_[0], "a number");
      const long last = label(fields_[1], "a number");
      const long step = fields_.size() > 2 ? label(fields_[2], "a step") : 1;
      if (step < 1) fail("the step of a generated set is positive");
      for (long number = first; number <= last; number += step) put(number);
      return;
    }
    for (const std::string_view field : fields_) {
      if (field.empty()) continue;
      if (const MeshGroup* other = other_group(field)) {
        const MeshGroup copy = *other;
        MeshGroup& own = builder_.group(set_);
        own.nodes.insert(own.nodes.end(), copy.nodes.begin(), copy.nodes.end());
        own.elements.insert(own.elements.end(), copy.elements.begin(), copy.elements.end());
        continue;
      }
      put(label(field, of_nodes ? "a node or a set of nodes" : "an element or a set of elements"));
    }
  }

  const MeshGroup* other_group(std::string_view field) {
    const auto named = names_.find(large(field));
    return named == names_.end() || number_in<long>(field) ? nullptr
                                                           : &builder_.group(named->second);
  }

  /// Faces S1.. of elements, from one corner to the next.
  void read_surface() {
    if (of_nodes_) {
      read_nodes_of_surface();
      return;
    }
    if (fields_.size() < 2) fail("a surface names elements and a face of theirs, S1 to S4");
    const std::string face = large(fields_[1]);
    const bool valid = face.size() == 2 && face[0] == 'S' && face[1] >= '1' && face[1] <= '4';
    if (!valid) fail(fmt::format("expected a face S1 to S4, got '{}'", shown_text(fields_[1])));
    std::vector<long> elements;
    if (const MeshGroup* group = other_group(fields_[0])) {
      elements = labels_of(*group);
    } else {
      elements.push_back(label(fields_[0], "an element or a set of elements"));
    }
    for (const long element : elements) add_face(element, static_cast<std::size_t>(face[1] - '1'));
  }

  void read_nodes_of_surface() {
    MeshGroup nodes;
    if (const MeshGroup* group = other_group(fields_[0]))
      nodes = *group;
    else
      nodes.nodes.push_back(builder_.node(label(fields_[0], "a node or a set of nodes"), line_));
    MeshGroup& own = builder_.group(set_);
    own.nodes.insert(own.nodes.end(), nodes.nodes.begin(), nodes.nodes.end());
  }

  std::vector<long> labels_of(const MeshGroup& group) const {
    std::vector<long> labels;
    for (const std::size_t e : group.elements) labels.push_back(builder_.label_of(e));
    return labels;
  }

  void add_face(long element, std::size_t face) {
    const std::vector<std::size_t>& nodes = builder_.element_nodes(element, line_);
    const auto kind = kinds_.find(element);
    if (kind == kinds_.end() || !kind->second.kind)
      fail(fmt::format("element {} has no faces", element));
    const std::size_t corners = corners_of(*kind->second.kind);
    if (face >= corners) fail(fmt::format("element {} has no face S{}", element, face + 1));
    MeshGroup& own = builder_.group(set_);
    own.nodes.push_back(nodes[face]);
    own.nodes.push_back(nodes[(face + 1) % corners]);
    if (nodes.size() > corners) own.nodes.push_back(nodes[corners + face]);
  }

  std::string_view text_;
  std::vector<std::string_view> fields_;
  std::size_t line_ = 0;
  MeshBuilder builder_;
  std::string keyword_;
  std::string set_;
  bool generate_ = false;
  bool of_nodes_ = false;
  AbaqusElement element_;
  std::optional<long> pending_;  ///< the element at hand
  std::vector<long> nodes_;
  std::unordered_map<long, AbaqusElement> kinds_;
  std::map<std::string, std::string> names_;
};

}  // namespace

MeshFileReading read_abaqus(std::string_view text, const std::string& shown) {
  try {
    return AbaqusReader(text).read();
  } catch (const MeshMistake& mistake) {
    return {{}, {}, fmt::format("{}:{}: {}", shown, mistake.line, mistake.what())};
  }
}

}  // namespace flexura

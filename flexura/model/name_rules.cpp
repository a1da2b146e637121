#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "flexura/model/rules.hpp"

namespace flexura {
namespace {

/// Names head columns as "body.point.x": they must not hold what separates names, columns or rows.
void check_column_word(const KeyPath& path, const std::string& name, Mistakes& mistakes) {
  const auto forbidden = [](char c) {
    return c == '.' || c == ',' || c == '"' || c == '/' || static_cast<unsigned char>(c) < 32;
  };
  if (name.empty()) {
    mistakes.add_independent(path, "a name must not be empty");
  } else if (std::any_of(name.begin(), name.end(), forbidden)) {
    mistakes.add_independent(
        path,
        fmt::format("the name '{}' must not contain '.', ',', '\"', '/' or a line break", name));
  }
}

template <typename Entities, typename Check>
void check_all(const KeyPath& path, const Entities& entities, Mistakes& mistakes,
               const Check& check_word) {
  std::unordered_set<std::string> names;
  for (const auto& entity : entities) {
    check_word(path / entity.name, entity.name);
    if (!names.insert(entity.name).second) {
      mistakes.add_independent(path / entity.name,
                               fmt::format("the name '{}' is given twice", entity.name));
    }
  }
}

/// A flexure's columns are `<flexure>.mid.x`, a point's `<body>.<point>.x`.
void check_mid_columns(const Model& model, Mistakes& mistakes) {
  std::unordered_set<std::string> taken;
  for (const Body& body : model.bodies) {
    for (const Point& point : body.points) {
      if (point.name == "mid") taken.insert(body.name);
    }
  }
  for (const Flexure& flexure : model.flexures) {
    if (taken.contains(flexure.name)) {
      mistakes.add_independent(
          {"flexures", flexure.name},
          fmt::format("its midpoint and the point 'mid' of body '{}' would share columns of the "
                      "results; rename one",
                      flexure.name));
    }
  }
}

}  // namespace

bool is_file_word(const std::string& word) {
  return !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
}

void check_names(const Model& model, Mistakes& mistakes) {
  const auto column_word = [&](const KeyPath& path, const std::string& name) {
    check_column_word(path, name, mistakes);
  };
  const auto file_word = [&](const KeyPath& path, const std::string& name) {
    if (!is_file_word(name)) {
      mistakes.add_independent(
          path,
          fmt::format("the study name '{}' becomes a folder: only letters, digits, _ and -", name));
    }
  };
  const auto any_word = [](const KeyPath&, const std::string&) {};
  check_all({"materials"}, model.materials, mistakes, any_word);
  check_all({"sections"}, model.sections, mistakes, any_word);
  check_all({"bodies"}, model.bodies, mistakes, column_word);
  for (const Body& body : model.bodies) {
    check_all({"bodies", body.name, "points"}, body.points, mistakes, column_word);
  }
  check_all({"flexures"}, model.flexures, mistakes, column_word);
  check_all({"springs"}, model.springs, mistakes, any_word);
  check_all({"joints"}, model.joints, mistakes, column_word);
  check_all({"drivers"}, model.drivers, mistakes, column_word);
  check_all({"studies"}, model.studies, mistakes, file_word);
  check_mid_columns(model, mistakes);
}

}  // namespace flexura

#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "flexura/core/diagnostics.hpp"
#include "flexura/core/units.hpp"
#include "flexura/io/expression.hpp"
#include "flexura/io/toml_document.hpp"
#include "flexura/model/validation.hpp"

namespace flexura {

/// What the reading of one model file has established so far, and every mistake met. A reader
/// that meets a mistake reports it and goes on with some harmless value: later rules keep quiet
/// about whatever has a mistake already.
class Reading {
 public:
  /// "path: message" at the position.
  void report(const KeyPath& path, SourcePosition position, const std::string& message);

  /// "path of the table: message", about one of its keys.
  void report_key(const KeyPath& table, const std::string& key, SourcePosition position,
                  const std::string& message);

  /// The same for what is allowed but hardly meant: no mistake of the path.
  void warn(const KeyPath& path, SourcePosition position, const std::string& message);

  /// Counts the path as mistaken without a report: another one explains it.
  void spoil(const KeyPath& path) { mistaken_.insert(path); }

  /// Whether something at this path, above it or below it was reported.
  bool has_mistake(const KeyPath& path) const;

  const Diagnostics& diagnostics() const { return diagnostics_; }

  std::filesystem::path folder;  ///< of the model file: what it names by file is looked for here
  UnitSystem units;
  Formulas formulas;  ///< knows the parameters
  /// Parameters that exist but have no value because of a mistake reported already.
  std::set<std::string> spoilt_parameters;
  std::vector<std::string> parameter_names;

 private:
  Diagnostics diagnostics_;
  std::set<KeyPath> mistaken_;
};

/// A value and the keys that lead to it.
struct Place {
  const TomlNode* node;
  KeyPath path;
};

/// "expected <what>, got <the value>" at the value.
void report_unexpected(Reading& reading, const Place& place, const std::string& what);

/// Whether a formula reads well and names parameters alone, or these variables; reports if not.
bool check_formula(Reading& reading, const KeyPath& path, SourcePosition position,
                   const std::string& formula, const std::string& quoted,
                   const std::vector<std::string>& variables = {});

/// The value of a formula such as " 2*t"; nothing after a mistake. `quoted` is how the user wrote
/// it, for messages.
std::optional<double> evaluate(Reading& reading, const KeyPath& path, SourcePosition position,
                               const std::string& formula, const std::string& quoted);

/// A quantity in declared units (angles in radians): a plain number, a string with a unit of this
/// dimension, or an expression of the parameters. Finite. Nothing after a mistake.
std::optional<double> read_quantity(Reading& reading, const Place& place,
                                    const Dimension& dimension);

std::optional<Vec2> read_vector(Reading& reading, const Place& place, const Dimension& dimension);
std::optional<bool> read_boolean(Reading& reading, const Place& place);
std::optional<int> read_integer(Reading& reading, const Place& place);
std::optional<std::string> read_text(Reading& reading, const Place& place);

/// The elements of a list; none, after a report, if the value is not a list.
std::vector<Place> read_list(Reading& reading, const Place& place, const std::string& of_what);

/// The entries of a table of named things, in the order of the file.
struct NamedPlace {
  std::string name;
  SourcePosition position;
  Place place;
};
std::vector<NamedPlace> read_names(Reading& reading, const Place& place);

}  // namespace flexura

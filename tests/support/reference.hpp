#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace flexura::testing {

/// A table of tests/data/reference, by its name in folder `static` or as "folder/name" (README.md
/// of the folder says how the numbers were obtained).
class ReferenceTable {
 public:
  explicit ReferenceTable(const std::string& file);

  std::size_t size() const { return rows_.size(); }
  const std::string& text(std::size_t row, const std::string& column) const;
  double number(std::size_t row, const std::string& column) const;
  /// The rows whose column holds that text, in order.
  std::vector<std::size_t> rows_where(const std::string& column, const std::string& text) const;

 private:
  std::size_t column(const std::string& name) const;

  std::string file_;
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
};

nlohmann::json read_reference_json(const std::string& file);

/// A number that the file prints as a number or, to keep all of its digits, as text.
double number_of(const nlohmann::json& value);

}  // namespace flexura::testing

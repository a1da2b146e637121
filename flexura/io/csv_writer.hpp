#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "flexura/core/vec2.hpp"

namespace flexura {

/// A CSV file's text, or the sentence that says which value it cannot carry.
struct CsvText {
  std::string text;
  std::string error;
};

/// Rows of named columns. Remembers the first value that is not a finite number.
class CsvWriter {
 public:
  explicit CsvWriter(std::vector<std::string> columns);

  CsvWriter& word(const std::string& text);
  /// The shortest text that reads back to the same double.
  CsvWriter& number(double value);
  CsvWriter& vector(Vec2 v) { return number(v.x).number(v.y); }
  void end_row();

  CsvText result() &&;

 private:
  std::string& separate();

  std::vector<std::string> columns_;
  std::string text_;
  std::string error_;
  std::size_t column_ = 0;
  int row_ = -1;  // the header; data rows count from 0, as the steps do
};

}  // namespace flexura

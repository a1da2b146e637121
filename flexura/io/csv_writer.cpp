#include "flexura/io/csv_writer.hpp"

#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace flexura {
namespace {

/// Names are the engineer's: quoted where they hold what separates fields.
std::string field(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
  std::string quoted = "\"";
  for (const char c : name) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace

CsvWriter::CsvWriter(std::vector<std::string> columns) : columns_(std::move(columns)) {
  for (const std::string& name : columns_) separate() += field(name);
  end_row();
}

CsvWriter& CsvWriter::word(const std::string& text) {
  separate() += field(text);
  return *this;
}

CsvWriter& CsvWriter::number(double value) {
  if (!std::isfinite(value) && error_.empty()) {
    error_ = fmt::format("row {}: {} is not a finite number", row_, columns_[column_]);
  }
  // Shortest text that reads back the same; + 0.0 writes the negative zero as 0.
  fmt::format_to(std::back_inserter(separate()), "{}", value + 0.0);
  return *this;
}

void CsvWriter::end_row() {
  text_ += '\n';
  column_ = 0;
  ++row_;
}

CsvText CsvWriter::result() && {
  return error_.empty() ? CsvText{std::move(text_), {}} : CsvText{{}, std::move(error_)};
}

std::string& CsvWriter::separate() {
  if (column_++ > 0) text_ += ',';
  return text_;
}

}  // namespace flexura

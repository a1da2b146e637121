#include "tests/support/reference.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace flexura::testing {
namespace {

std::ifstream open_reference(const std::string& name) {
  const bool in_folder = name.find('/') != std::string::npos;
  const std::string file = in_folder ? name : "static/" + name;
  std::ifstream stream(std::string(FLEXURA_SOURCE_DIR) + "/tests/data/reference/" + file);
  if (!stream) throw std::runtime_error("cannot read " + file);
  return stream;
}

/// Cells between commas; a comma inside double quotes belongs to its cell.
std::vector<std::string> split_cells(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else if (c != '\r')
      cells.back() += c;
  }
  return cells;
}

}  // namespace

ReferenceTable::ReferenceTable(const std::string& file) : file_(file) {
  std::ifstream stream = open_reference(file);
  std::string line;
  std::getline(stream, line);
  header_ = split_cells(line);
  while (std::getline(stream, line)) {
    rows_.push_back(split_cells(line));
    if (rows_.back().size() != header_.size()) throw std::runtime_error("ragged row in " + file);
  }
}

std::size_t ReferenceTable::column(const std::string& name) const {
  const auto found = std::find(header_.begin(), header_.end(), name);
  if (found == header_.end()) throw std::invalid_argument("no column " + name + " in " + file_);
  return static_cast<std::size_t>(found - header_.begin());
}

const std::string& ReferenceTable::text(std::size_t row, const std::string& name) const {
  return rows_.at(row)[column(name)];
}

double ReferenceTable::number(std::size_t row, const std::string& name) const {
  return std::stod(text(row, name));
}

std::vector<std::size_t> ReferenceTable::rows_where(const std::string& name,
                                                    const std::string& value) const {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < rows_.size(); ++row)
    if (text(row, name) == value) rows.push_back(row);
  if (rows.empty()) throw std::invalid_argument("no row " + value + " in " + file_);
  return rows;
}

nlohmann::json read_reference_json(const std::string& file) {
  std::ifstream stream = open_reference(file);
  return nlohmann::json::parse(stream);
}

double number_of(const nlohmann::json& value) {
  return value.is_string() ? std::stod(value.get<std::string>()) : value.get<double>();
}

}  // namespace flexura::testing

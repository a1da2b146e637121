#include "flexura/io/history_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "flexura/core/nearest_word.hpp"
#include "flexura/core/units.hpp"
#include "flexura/io/text_file.hpp"

namespace flexura {
namespace {

struct Field {
  std::string_view text;
  std::size_t start = 0;  ///< byte of its line
};

std::vector<Field> fields_of(std::string_view line) {
  std::vector<Field> fields;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t end = std::min(line.find(',', start), line.size());
    std::string_view text = trimmed(line.substr(start, end - start));
    const std::size_t first =
        text.empty() ? start : static_cast<std::size_t>(text.data() - line.data());
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
      text = text.substr(1, text.size() - 2);
    fields.push_back({text, first});
    start = end + 1;
  }
  return fields;
}

/// Reads a text line by line, and numbers from two of its columns.
class ColumnReader {
 public:
  ColumnReader(std::string_view text, const HistoryColumns& columns)
      : text_(text), columns_(columns) {}

  HistoryFileReading read() {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
    if (!find_columns()) return std::move(result_);
    for (auto line = next_line(); line; line = next_line())
      if (!read_row(*line)) return std::move(result_);
    const std::size_t rows = result_.times.size();
    if (rows < 2)
      fail("file", fmt::format("'{}' has {} of numbers; a history needs two or more", columns_.file,
                               rows == 1 ? "one line" : "no line"));
    return std::move(result_);
  }

 private:
  bool fail(const char* key, std::string error) {
    result_.key = key;
    result_.error = std::move(error);
    return false;
  }

  /// What is wrong where in the line; columns count characters, of which UTF-8 may have several
  /// bytes, from 1.
  bool fail_at(std::size_t byte, const std::string& what) {
    const std::string_view before = current_.substr(0, byte);
    const auto column = 1 + std::count_if(before.begin(), before.end(), [](char c) {
                          return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
                        });
    return fail("file", fmt::format("{}:{}:{}: {}", columns_.file, line_, column, what));
  }

  /// The next line that is not empty.
  std::optional<std::string_view> next_line() {
    while (!text_.empty()) {
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      current_ = text_.substr(0, end);
      text_.remove_prefix(std::min(end + 1, text_.size()));
      ++line_;
      if (!trimmed(current_).empty()) return current_;
    }
    return {};
  }

  bool find_columns() {
    const auto head = next_line();
    if (!head) return fail("file", fmt::format("'{}' is empty", columns_.file));
    std::vector<std::string> names;
    for (const Field& field : fields_of(*head)) names.emplace_back(field.text);
    const auto find = [&](const char* key, const std::string& name, std::size_t& index) {
      const auto at = std::find(names.begin(), names.end(), name);
      index = static_cast<std::size_t>(at - names.begin());
      if (at != names.end()) return true;
      std::transform(names.begin(), names.end(), names.begin(), shown_text);
      return fail(key, fmt::format("'{}' has no column '{}'{}", columns_.file, name,
                                   suggestion(name, names)));
    };
    return find("time", columns_.time, time_) && find("value", columns_.value, value_);
  }

  std::optional<double> number_in(const std::vector<Field>& fields, std::size_t index,
                                  const std::string& name) {
    if (index >= fields.size()) {
      fail_at(0, fmt::format("the line ends before column '{}'", name));
      return {};
    }
    const auto number = read_number(fields[index].text);
    if (!number)
      fail_at(fields[index].start, fmt::format("'{}' in column '{}' is not a number",
                                               shown_text(fields[index].text), name));
    return number;
  }

  bool read_row(std::string_view line) {
    const std::vector<Field> fields = fields_of(line);
    const auto time = number_in(fields, time_, columns_.time);
    const auto value = time ? number_in(fields, value_, columns_.value) : std::nullopt;
    if (!value) return false;
    auto& times = result_.times;
    if (!times.empty() && *time <= times.back())
      return fail_at(
          fields[time_].start,
          fmt::format("times must ascend: {} does not come after {}", *time, times.back()));
    times.push_back(*time);
    result_.values.push_back(*value);
    return true;
  }

  std::string_view text_;     ///< what is still to be read
  std::string_view current_;  ///< the line at hand
  const HistoryColumns& columns_;
  std::size_t line_ = 0;
  std::size_t time_ = 0;
  std::size_t value_ = 0;
  HistoryFileReading result_;
};

}  // namespace

HistoryFileReading read_history_file(const std::filesystem::path& path,
                                     const HistoryColumns& columns) {
  const TextReading file = read_text_file(path, columns.file, longest_history_file);
  if (!file.error.empty()) return {{}, {}, file.error, "file"};
  return read_history_text(file.text, columns);
}

HistoryFileReading read_history_text(std::string_view text, const HistoryColumns& columns) {
  return ColumnReader(text, columns).read();
}

}  // namespace flexura

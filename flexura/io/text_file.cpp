#include "flexura/io/text_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

namespace flexura {

bool is_named_pipe(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_fifo(path, error)) return false;
  static_cast<void>(
      std::filesystem::canonical(path, error));  // a pipe between processes has no place of its own
  return !error;
}

TextReading read_text_file(const std::filesystem::path& path, const std::string& shown,
                           std::size_t longest) {
  const auto refuse = [&](const std::string& why) {
    return TextReading{{}, fmt::format("cannot read '{}': {}", shown, why)};
  };
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return refuse("it is a directory");
  if (is_named_pipe(path)) return refuse("it is a named pipe");
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return refuse(std::strerror(errno));
  TextReading result;
  std::vector<char> block(std::size_t{1} << 20U);
  while (
      result.text.size() <= longest &&
      (stream.read(block.data(), static_cast<std::streamsize>(block.size())), stream.gcount() > 0))
    result.text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
  if (stream.bad()) return refuse("reading failed");
  if (result.text.size() > longest)
    return refuse(fmt::format("it is longer than {} MB", longest >> 20U));
  return result;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string shown_text(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string readable(text.substr(0, longest));
  std::replace_if(
      readable.begin(), readable.end(), [](char c) { return c < 32 || c > 126; }, '?');
  return readable;
}

}  // namespace flexura

#include "tests/house/rules.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <optional>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace flexura::house {
namespace {

struct Room {
  std::string_view folder;
  int rank;
};

// From what knows nothing of mechanics up to the faces of the program. Rooms of one rank do not
// know of each other.
constexpr std::array rooms = {
    Room{"flexura/core", 0},     Room{"flexura/geometry", 1}, Room{"flexura/energy", 1},
    Room{"flexura/assembly", 1}, Room{"flexura/solvers", 1},  Room{"flexura/results", 1},
    Room{"flexura/model", 2},    Room{"flexura/report", 2},   Room{"flexura/modelings", 3},
    Room{"flexura/pictures", 2}, Room{"flexura/io", 3},       Room{"flexura/studies", 4},
    Room{"apps/flexura", 5},
};

constexpr std::array modelings = {"linear", "scmbm", "prbm", "exact", "beam", "bcm", "continuum"};

constexpr std::size_t most_columns = 100;
constexpr std::size_t most_lines = 400;

std::optional<Room> room_of(std::string_view path) {
  const auto room = std::ranges::find_if(rooms, [&](const Room& candidate) {
    return path.starts_with(candidate.folder) && path.substr(candidate.folder.size(), 1) == "/";
  });
  return room == rooms.end() ? std::nullopt : std::optional(*room);
}

/// The modeling that a file of that room belongs to, by its folder or by its own name
/// ("exact/..", "exact.hpp", "exact_flexure.hpp"); empty for what modelings share.
std::string_view modeling_of(std::string_view path) {
  constexpr std::string_view home = "flexura/modelings/";
  if (!path.starts_with(home)) return {};
  const std::string_view name = path.substr(home.size());
  for (const std::string_view modeling : modelings) {
    if (name.starts_with(modeling) && name.size() > modeling.size() &&
        std::string_view("/._").find(name[modeling.size()]) != std::string_view::npos)
      return modeling;
  }
  return {};
}

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  std::istringstream stream{std::string(text)};
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Characters, not bytes: a continuation byte of UTF-8 (10xxxxxx) takes no column.
std::size_t columns(std::string_view line) {
  return static_cast<std::size_t>(
      std::ranges::count_if(line, [](unsigned char byte) { return (byte & 0xC0U) != 0x80U; }));
}

std::string place(std::string_view file, std::size_t line) {
  return std::string(file) + ":" + std::to_string(line) + ": ";
}

/// What is wrong with `from` including `to`; empty if nothing is.
std::string include_offence(std::string_view from, const Room& home, const std::string& to) {
  const std::optional<Room> target = room_of(to);
  if (!target) return "includes " + to + ", which stands in no room";
  if (target->folder != home.folder && target->rank >= home.rank) {
    return "rank " + std::to_string(home.rank) + " includes " + to + " of rank " +
           std::to_string(target->rank);
  }
  const std::string_view own = modeling_of(from);
  const std::string_view other = modeling_of(to);
  if (!own.empty() && !other.empty() && own != other)
    return "modeling " + std::string(own) + " includes " + to + " of another modeling";
  return {};
}

}  // namespace

Offences room_offences(std::string_view file, std::string_view text) {
  const std::optional<Room> home = room_of(file);
  if (!home) return {place(file, 1) + "stands in no room"};
  // An include in quotes that does not start at the top of the checkout would hide its room, so
  // every quoted one counts; angle brackets count if they lead into the house.
  static const std::regex pattern(
      R"re(^\s*#\s*include\s*(?:"([^"]+)"|<((?:flexura|apps)/[^>]+)>))re");
  Offences offences;
  const std::vector<std::string> lines = lines_of(text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::smatch match;
    if (!std::regex_search(lines[i], match, pattern)) continue;
    const std::string to = match[1].matched ? match[1].str() : match[2].str();
    if (const std::string offence = include_offence(file, *home, to); !offence.empty())
      offences.push_back(place(file, i + 1) + offence);
  }
  return offences;
}

Offences hygiene_offences(std::string_view file, std::string_view text) {
  Offences offences;
  const std::vector<std::string> lines = lines_of(text);
  if (file.ends_with(".hpp") && std::ranges::find(lines, "#pragma once") == lines.end())
    offences.push_back(place(file, 1) + "a header without #pragma once");
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (columns(lines[i]) > most_columns) {
      offences.push_back(place(file, i + 1) + std::to_string(columns(lines[i])) + " columns, " +
                         std::to_string(most_columns) + " is the most");
    }
  }
  if (lines.size() > most_lines) {
    offences.push_back(place(file, lines.size()) + std::to_string(lines.size()) + " lines, " +
                       std::to_string(most_lines) + " is the most");
  }
  return offences;
}

std::vector<std::string> sources_in(const std::vector<std::string>& folders) {
  const std::filesystem::path top = FLEXURA_SOURCE_DIR;
  std::vector<std::string> files;
  for (const std::string& folder : folders) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(top / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension == ".hpp" || extension == ".cpp" || extension == ".h")
        files.push_back(entry.path().lexically_relative(top).generic_string());
    }
  }
  std::ranges::sort(files);
  return files;
}

std::vector<std::string> documents() {
  const std::filesystem::path top = FLEXURA_SOURCE_DIR;
  std::vector<std::string> found;
  const auto note = [&](const std::filesystem::directory_entry& entry) {
    if (entry.path().extension() == ".md")
      found.push_back(entry.path().lexically_relative(top).generic_string());
  };
  for (const auto& entry : std::filesystem::directory_iterator(top)) note(entry);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(top / "docs")) note(entry);
  std::ranges::sort(found);
  return found;
}

std::string read_text(const std::string& file) {
  std::ifstream stream(std::filesystem::path(FLEXURA_SOURCE_DIR) / file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace flexura::house

#include "tests/pictures/picture_checks.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <sstream>

namespace flexura::pictures {
namespace {

/// Attributes hold no brackets, so that an element's tag ends at the next one.
void check_elements(const std::string& svg, std::vector<std::string>& faults) {
  std::vector<std::string> open;
  for (std::size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1)) {
    const std::size_t end = svg.find('>', at);
    if (end == std::string::npos || svg.find('<', at + 1) < end) {
      faults.push_back("no tag: " + svg.substr(at, 40));
      return;
    }
    const bool closes = svg[at + 1] == '/';
    const std::size_t begin = at + (closes ? 2 : 1);
    const std::string name = svg.substr(begin, svg.find_first_of(" />", begin) - begin);
    if (closes) {
      if (open.empty() || open.back() != name) faults.push_back("</" + name + "> closes nothing");
      if (!open.empty()) open.pop_back();
    } else if (svg[end - 1] != '/') {
      open.push_back(name);
    }
    if (count_of(svg.substr(at, end - at), "\"") % 2 != 0) faults.push_back("quotes of " + name);
  }
  if (!open.empty()) faults.push_back("<" + open.back() + "> stays open");
}

std::string letters(const std::string& data) {
  std::string kept;
  std::ranges::copy_if(data, std::back_inserter(kept),
                       [](unsigned char c) { return std::isalpha(c) != 0; });
  return kept;
}

void check_animations(const std::string& svg, std::vector<std::string>& faults) {
  const std::string begin = "<animate attributeName=\"d\"";
  for (std::size_t at = svg.find(begin); at != std::string::npos; at = svg.find(begin, at + 1)) {
    const std::size_t from = svg.find("values=\"", at) + 8;
    std::istringstream values(svg.substr(from, svg.find('"', from) - from));
    std::string first;
    for (std::string value; std::getline(values, value, ';');) {
      if (first.empty()) first = letters(value);
      if (letters(value) != first) faults.push_back("letters change: " + value);
    }
  }
}

}  // namespace

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

std::vector<std::string> picture_faults(const std::string& svg) {
  std::vector<std::string> faults;
  if (svg.rfind("<svg xmlns=", 0) != 0 || svg.size() < 7 ||
      svg.substr(svg.size() - 7) != "</svg>\n")
    faults.emplace_back("no whole svg");
  for (const char* word : {"nan", "inf\"", "\"\"", "http://www.w3.org/1999"})
    if (svg.find(word) != std::string::npos) faults.push_back(std::string("contains ") + word);
  check_elements(svg, faults);
  check_animations(svg, faults);
  return faults;
}

}  // namespace flexura::pictures

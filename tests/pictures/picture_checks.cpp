#include "tests/pictures/picture_checks.hpp"

#include <algorithm>
#include <regex>
#include <sstream>

namespace flexura::pictures {
namespace {

void check_elements(const std::string& svg, std::vector<std::string>& faults) {
  static const std::regex tag("<(/?)([A-Za-z]+)((?:[^<>\"]|\"[^\"<]*\")*?)(/?)>");
  std::vector<std::string> open;
  std::size_t brackets = 0;
  for (std::sregex_iterator it(svg.begin(), svg.end(), tag), end; it != end; ++it) {
    ++brackets;
    const std::string name = (*it)[2];
    if ((*it)[1].length() == 0) {
      if ((*it)[4].length() == 0) open.push_back(name);
      continue;
    }
    if (open.empty() || open.back() != name) faults.push_back("</" + name + "> closes nothing");
    if (!open.empty()) open.pop_back();
  }
  if (!open.empty()) faults.push_back("<" + open.back() + "> stays open");
  if (brackets != count_of(svg, "<")) faults.emplace_back("a bracket outside of elements");
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

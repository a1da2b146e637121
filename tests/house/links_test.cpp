// Every link in a document leads somewhere: to a file of the checkout and, with a #part, to a
// heading of it, named as GitHub names them.
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/house/rules.hpp"

namespace flexura::house {
namespace {

namespace fs = std::filesystem;

/// The text without its fenced blocks, in which nothing is a heading or a link.
std::string without_blocks(const std::string& text) {
  std::istringstream lines(text);
  std::string kept;
  bool in_block = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```"))
      in_block = !in_block;
    else if (!in_block)
      kept += line + "\n";
  }
  return kept;
}

struct Link {
  std::string file;  ///< empty: the document itself
  std::string part;  ///< without #; empty: the whole
};

/// Targets of links and pictures within the checkout.
std::vector<Link> local_links(const std::string& text) {
  static const std::regex pattern(R"(\]\(([^)#\s]*)#?([^)\s]*)[^)]*\))");
  const std::string plain = without_blocks(text);
  std::vector<Link> links;
  for (std::sregex_iterator match(plain.begin(), plain.end(), pattern), end; match != end; ++match)
    if ((*match)[1].str().find(':') == std::string::npos)
      links.push_back({(*match)[1], (*match)[2]});
  static const std::regex picture(R"re(<img src="([^":]+)")re");
  for (std::sregex_iterator match(plain.begin(), plain.end(), picture), end; match != end; ++match)
    links.push_back({(*match)[1], {}});
  return links;
}

/// "Paths: `a.csv`" becomes "paths-acsv".
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : std::regex_replace(heading, std::regex(R"(\[([^\]]*)\]\([^)]*\))"), "$1")) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ')
      anchor += '-';
    else if (std::isalnum(byte) != 0 || c == '-' || c == '_' || byte >= 0x80)
      anchor += static_cast<char>(std::tolower(byte));
  }
  return anchor;
}

/// Of all headings; a second of the same name has "-1" behind it.
std::set<std::string> anchors(const std::string& text) {
  static const std::regex pattern("(?:^|\n)#{1,6} +([^\n]*)");
  const std::string plain = without_blocks(text);
  std::map<std::string, int> count;
  std::set<std::string> found;
  for (std::sregex_iterator match(plain.begin(), plain.end(), pattern), end; match != end;
       ++match) {
    const std::string anchor = anchor_of((*match)[1]);
    const int before = count[anchor]++;
    found.insert(before == 0 ? anchor : anchor + "-" + std::to_string(before));
  }
  return found;
}

TEST(Links, AreRecognised) {
  std::string found;
  for (const Link& link : local_links("[a](docs/a.md#top) ![b](b.png \"title\") [c](https://c.org) "
                                      "[d](#d)\n```\n[e](e)\n```\n"))
    found += link.file + "#" + link.part + " ";
  EXPECT_EQ(found, "docs/a.md#top b.png# #d ");
}

TEST(Links, HeadingsHaveNames) {
  EXPECT_EQ(anchors("# Top\n\n## Paths: `<study>/<label>.csv`\n```sh\n# no heading\n```\n### Top\n"
                    "## [A b](c.md), d\n"),
            (std::set<std::string>{"top", "paths-studylabelcsv", "top-1", "a-b-d"}));
}

TEST(Links, LeadSomewhere) {
  ASSERT_FALSE(documents().empty());
  const fs::path top = FLEXURA_SOURCE_DIR;
  for (const std::string& name : documents()) {
    const std::string text = read_text(name);
    for (const Link& link : local_links(text)) {
      const fs::path target = (fs::path(name).parent_path() / link.file).lexically_normal();
      EXPECT_TRUE(link.file.empty() || fs::exists(top / target)) << name << ": " << link.file;
      if (link.part.empty() || !(link.file.empty() || target.extension() == ".md")) continue;
      if (!link.file.empty() && !fs::exists(top / target)) continue;
      const std::string aim = link.file.empty() ? text : read_text(target.generic_string());
      EXPECT_TRUE(anchors(aim).contains(link.part))
          << name << ": " << link.file << "#" << link.part;
    }
  }
}

/// Documents that can be reached from one, itself included, by following links.
std::set<std::string> reached_from(const std::string& document) {
  std::set<std::string> found = {document};
  std::vector<std::string> ahead = {document};
  while (!ahead.empty()) {
    const std::string name = ahead.back();
    ahead.pop_back();
    for (const Link& link : local_links(read_text(name))) {
      const fs::path target = (fs::path(name).parent_path() / link.file).lexically_normal();
      const bool exists = fs::exists(fs::path(FLEXURA_SOURCE_DIR) / target);
      if (link.file.empty() || target.extension() != ".md" || !exists) continue;
      if (found.insert(target.generic_string()).second) ahead.push_back(target.generic_string());
    }
  }
  return found;
}

TEST(Links, LeadFromTheReadmeToEveryDocument) {
  const std::set<std::string> reached = reached_from("README.md");
  for (const std::string& name : documents()) EXPECT_TRUE(reached.contains(name)) << name;
}

}  // namespace
}  // namespace flexura::house

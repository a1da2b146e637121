// What the documents promise, as far as a program can tell: links lead somewhere, models are
// valid, and every package that the scripts install is accounted for.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>

#include "tests/house/rules.hpp"

namespace flexura::house {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match)
    found.push_back((*match)[1]);
  return found;
}

/// Targets of Markdown links and pictures within the checkout, without their #section.
std::vector<std::string> local_links(const std::string& text) {
  std::vector<std::string> links;
  for (const std::string& link : matches(text, R"(\]\(([^)#\s]+)[^)]*\))")) {
    if (link.find(':') == std::string::npos) links.push_back(link);
  }
  for (const std::string& picture : matches(text, R"re(<img src="([^":]+)")re"))
    links.push_back(picture);
  return links;
}

std::vector<fs::path> documents() {
  const fs::path top = FLEXURA_SOURCE_DIR;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(top))
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  for (const auto& entry : fs::recursive_directory_iterator(top / "docs"))
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  return found;
}

/// The names in the arrays `.._packages=( .. )` of scripts/setup.sh.
std::vector<std::string> installed_packages() {
  std::vector<std::string> packages;
  for (const std::string& group :
       matches(read_text("scripts/setup.sh"), R"([a-z]_packages=\(([^)]*)\))")) {
    for (const std::string& package : matches(group, R"(([a-z0-9][a-z0-9.+-]*))"))
      packages.push_back(package);
  }
  return packages;
}

TEST(Documents, LinksAreRecognised) {
  EXPECT_EQ(local_links("[a](docs/a.md#top) ![b](b.png \"title\") [c](https://c.org) [d](#d)"),
            (std::vector<std::string>{"docs/a.md", "b.png"}));
  EXPECT_EQ(local_links("[<img src=\"c.svg\" width=\"9\">](#d)"),
            std::vector<std::string>{"c.svg"});
}

TEST(Documents, LinksLeadSomewhere) {
  ASSERT_FALSE(documents().empty());
  for (const fs::path& document : documents()) {
    const std::string name = document.lexically_relative(FLEXURA_SOURCE_DIR).generic_string();
    for (const std::string& link : local_links(read_text(name)))
      EXPECT_TRUE(fs::exists(document.parent_path() / link)) << name << " links to " << link;
  }
}

/// The complete models among a document's TOML blocks.
std::vector<std::string> models(const std::string& text) {
  return matches(text, "```toml\n(flexura = 1[^`]*)```");
}

TEST(Documents, ModelsAreRecognised) {
  EXPECT_EQ(models("```toml\nflexura = 1\na = 2\n```\n```toml\n[units]\n```\n"),
            std::vector<std::string>{"flexura = 1\na = 2\n"});
}

TEST(Documents, ModelsAreValid) {
  const fs::path folder = fs::path(testing::TempDir()) / "flexura_documents";
  fs::create_directories(folder);
  for (const fs::path& document : documents()) {
    const std::string name = document.lexically_relative(FLEXURA_SOURCE_DIR).generic_string();
    for (const std::string& model : models(read_text(name))) {
      const fs::path file = folder / "model.toml";
      std::ofstream(file) << model;
      const std::string command =
          "'" FLEXURA_EXECUTABLE "' check '" + file.string() + "' 1>&2 </dev/null";
      EXPECT_EQ(std::system(command.c_str()), 0) << "of " << name << ":\n" << model;
    }
  }
  fs::remove_all(folder);
}

TEST(Documents, EveryInstalledPackageIsAccountedFor) {
  const std::string text = read_text("docs/dependencies.md");
  ASSERT_FALSE(installed_packages().empty());
  for (const std::string& package : installed_packages()) {
    EXPECT_NE(text.find("`" + package + "`"), std::string::npos)
        << package << " is missing in docs/dependencies.md";
  }
}

}  // namespace
}  // namespace flexura::house

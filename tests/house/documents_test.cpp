// What the documents promise, as far as a program can tell: models are valid, every package that
// the scripts install is accounted for, the manual page has every option, and there is one version.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>

#include "tests/house/rules.hpp"
#include "tests/support/shell.hpp"

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

/// The complete models among a document's TOML blocks.
std::vector<std::string> models(const std::string& text) {
  return matches(text, "```toml\n(flexura = 1[^`]*)```");
}

TEST(Documents, ModelsAreRecognised) {
  EXPECT_EQ(models("```toml\nflexura = 1\na = 2\n```\n```toml\n[units]\n```\n"),
            std::vector<std::string>{"flexura = 1\na = 2\n"});
}

TEST(Documents, ModelsAreValid) {
  const fs::path folder = fs::path(::testing::TempDir()) / "flexura_documents";
  fs::create_directories(folder);
  for (const std::string& name : documents()) {
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

TEST(Documents, ManualPageHasEveryOption) {
  std::string page = read_text("apps/flexura/flexura.1.in");
  std::erase(page, '\\');
  for (const char* command : {"", "run", "check", "draw", "new"}) {
    const std::string help =
        testing::ask_shell("'" FLEXURA_EXECUTABLE "' " + std::string(command) + " --help").text;
    EXPECT_NE(page.find("flexura " + std::string(command)), std::string::npos) << command;
    const std::vector<std::string> options = matches(help, "(--[a-z]+)");
    ASSERT_FALSE(options.empty()) << help;
    for (const std::string& option : options)
      EXPECT_NE(page.find(option), std::string::npos) << option << " of flexura " << command;
  }
}

TEST(Documents, ThereIsOneVersion) {
  const std::string version =
      matches(read_text("CMakeLists.txt"), R"(project\(flexura VERSION (\S+))").at(0);
  EXPECT_EQ(testing::ask_shell("'" FLEXURA_EXECUTABLE "' --version").text,
            "flexura " + version + "\n");
  EXPECT_EQ(matches(read_text("CHANGELOG.md"), R"(\n## \[(\d[^\]]*)\])").at(0), version);
}

}  // namespace
}  // namespace flexura::house

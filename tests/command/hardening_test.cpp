// The command where the system around it fails: places that cannot be written, disks and memory
// that end, runs that are killed, files that are no files. Always a message and an exit status,
// never half a result, never a hang.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "tests/support/folder_test.hpp"
#include "tests/support/shell.hpp"

namespace flexura {
namespace {

namespace fs = std::filesystem;

class Hardening : public testing::FolderTest {
 protected:
  Hardening() {
    write("stage.toml", model("[studies.push]\nkind = \"path\"\nsteps = 3\nmodelings = "
                              "[\"linear\", \"exact\"]\n"
                              "loads = [{ on = \"stage.P\", force = [3.0, 0.0] }]\n"));
  }

  static std::string model(const std::string& studies, const std::string& thickness = "0.2") {
    return "flexura = 1\n[units]\nlength = \"mm\"\nforce = \"N\"\ntime = \"s\"\n"
           "[materials.steel]\nyoungs_modulus = \"210 GPa\"\npoissons_ratio = 0.3\n"
           "[sections.leaf]\nrectangle = { thickness = " +
           thickness +
           ", width = 10.0 }\n[bodies.ground]\nfixed = true\n"
           "[bodies.stage]\npoints = { P = [20.0, 50.0] }\n"
           "[flexures.left]\nbetween = [\"ground\", \"stage\"]\n"
           "axis = { line = [[0.0, 0.0], [0.0, 50.0]] }\nmaterial = \"steel\"\nsection = \"leaf\"\n"
           "[flexures.right]\nbetween = [\"ground\", \"stage\"]\n"
           "axis = { line = [[40.0, 0.0], [40.0, 50.0]] }\nmaterial = \"steel\"\n"
           "section = \"leaf\"\n" +
           studies;
  }
  /// Takes seconds.
  static std::string long_model() {
    std::string modelings;
    for (const char* label : {"a", "b", "c", "d", "e", "f", "g", "h"})
      modelings += std::string("{ name = \"exact\", label = \"") + label + "\" }, ";
    return model("[studies.push]\nkind = \"path\"\nsteps = 100000\nmodelings = [" + modelings +
                 "]\nloads = [{ on = \"stage.P\", force = [3.0, 0.0] }]\n");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(top_ / name, std::ios::binary) << text;
  }
  std::set<std::string> content() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(top_))
      names.insert(fs::relative(entry.path(), top_).string());
    return names;
  }
  /// In the test's folder, by the shell, for no longer than a minute; `before` sets limits.
  void run(const std::string& arguments, const std::string& before = "true") {
    answer_ = testing::ask_shell("cd '" + top_.string() + "' && " + before +
                                 " && timeout 60 '" FLEXURA_EXECUTABLE "' " + arguments +
                                 " 2>&1 </dev/null");
  }
  void expect(int status, const std::string& message) const {
    EXPECT_EQ(answer_.status, status) << answer_.text;
    EXPECT_NE(answer_.text.find(message), std::string::npos) << answer_.text;
  }

  testing::ShellAnswer answer_;
};

TEST_F(Hardening, FoldersThatCannotBeWritten) {
  run("run stage.toml -q -o /proc/flexura");
  expect(1, "Cannot write '/proc/flexura'");
  run("run stage.toml -q -o /dev/full");
  expect(1, "Cannot write '/dev/full'");
  run("run stage.toml -q -o stage.toml");
  expect(1, "Cannot write 'stage.toml'");
  if (::geteuid() == 0) return;  // whom no permission stops
  fs::create_directory(top_ / "closed");
  fs::permissions(top_ / "closed", fs::perms::owner_read | fs::perms::owner_exec);
  run("run stage.toml -q -o closed");
  expect(1, "Permission denied");
}

TEST_F(Hardening, DiskThatIsFullLeavesOldResultsWhole) {
  run("run stage.toml -q -o out");
  ASSERT_EQ(answer_.status, 0) << answer_.text;
  const std::string old = read("out/summary.json");
  const auto names = content();
  run("run stage.toml -q -o out", "ulimit -f 64");  // a limit on files stands for the disk
  expect(1, "Cannot write 'out/");
  EXPECT_EQ(read("out/summary.json"), old);
  EXPECT_EQ(content(), names);
  run("run stage.toml -q -o new", "ulimit -f 64");
  expect(1, "Cannot write 'new/");
  EXPECT_FALSE(fs::exists(top_ / "new"));
}

TEST_F(Hardening, KilledRunsLeaveOldResultsWhole) {
  run("run stage.toml -q -o out");
  ASSERT_EQ(answer_.status, 0) << answer_.text;
  const auto names = content();
  write("long.toml", long_model());
  const std::string command = "cd '" + top_.string() +
                              "' && timeout -s KILL 0.4 '" FLEXURA_EXECUTABLE
                              "' run long.toml -q -o out >/dev/null 2>&1 </dev/null";
  EXPECT_NE(std::system(command.c_str()), 0);
  fs::remove(top_ / "long.toml");
  EXPECT_EQ(content(), names);
}

TEST_F(Hardening, WhatAKilledRunLeftIsRemovedByTheNext) {
  fs::create_directories(top_ / "out");
  write("out/.summary.json.999999999.part", "{");  // no process has such a number
  write("out/.notes.999999999.part", "not ours");
  run("run stage.toml -q -o out");
  EXPECT_EQ(answer_.status, 0) << answer_.text;
  EXPECT_FALSE(fs::exists(top_ / "out/.summary.json.999999999.part"));
  EXPECT_TRUE(fs::exists(top_ / "out/.notes.999999999.part"));
}

TEST_F(Hardening, InterruptedRunsKeepWhatConverged) {
  write("long.toml", long_model());
  const std::string command = "cd '" + top_.string() +
                              "' && timeout --preserve-status -s INT 0.4 '" FLEXURA_EXECUTABLE
                              "' run long.toml -q -o out >said 2>&1 </dev/null";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 1) << read("said");
  EXPECT_NE(read("said").find("cancelled at load factor"), std::string::npos) << read("said");
  EXPECT_GT(read("out/push/a.csv").size(), 100U);
}

#if !defined(__SANITIZE_ADDRESS__)  // which reserves terabytes
TEST_F(Hardening, MemoryThatEnds) {
  write("big.toml",
        model("[studies.push]\nkind = \"path\"\nsteps = 2\nmodelings = [{ name = \"continuum\", "
              "elements = 4000, across = 20, order = 2 }]\n"
              "loads = [{ on = \"stage.P\", force = [3.0, 0.0] }]\n"));
  for (const char* limit : {"150000", "400000"}) {
    run("run big.toml -q -o out", std::string("ulimit -v ") + limit);
    expect(1, "out of memory");
    EXPECT_FALSE(fs::exists(top_ / "out"));
  }
}
#endif

TEST_F(Hardening, ModelsThatAreNoFiles) {
  ASSERT_EQ(::mkfifo((top_ / "pipe").c_str(), 0600), 0);
  fs::create_symlink("nowhere", top_ / "dangling.toml");
  fs::create_symlink("loop.toml", top_ / "loop.toml");
  fs::create_symlink("stage.toml", top_ / "link.toml");
  write("empty.toml", "");
  for (const char* verb : {"check ", "run "}) {
    run(verb + std::string("pipe"));
    expect(2, "pipe:1:1: error: this is a named pipe");
    run(verb + std::string("."));
    expect(2, "directory");
    run(verb + std::string("dangling.toml"));
    expect(2, "No such file");
    run(verb + std::string("loop.toml"));
    expect(2, "Too many levels of symbolic links");
    run(verb + std::string("empty.toml"));
    expect(2, "empty.toml:1:1: error: the file is empty");
  }
  run("check link.toml");
  EXPECT_EQ(answer_.status, 0) << answer_.text;
}

TEST_F(Hardening, WindowsTextIsReadAndItsPlacesAreRight) {
  std::string text = model("[studies.a]\nkind = \"pth\"\n");
  for (auto at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2))
    text.insert(at, "\r");
  write("windows.toml", "\xEF\xBB\xBF" + text);
  run("check windows.toml");
  expect(2, "windows.toml:26:8: error: studies.a.kind: unknown study kind 'pth'");
}

TEST_F(Hardening, NumbersBeyondAllMeasure) {
  const struct {
    const char* thickness;
    const char* message;
  } cases[] = {{"1e308", "is beyond 1e+60"},
               {"1e61", "is beyond 1e+60"},
               {"99999999999999999999", "64 bits"},
               {"nan", "finite"},
               {"inf", "finite"}};
  for (const auto& [thickness, message] : cases) {
    write("number.toml", model("", thickness));
    run("check number.toml");
    expect(2, message);
    expect(2, "number.toml:10:");
  }
}

/// Whatever a run on extreme numbers ends with, its files hold numbers.
TEST_F(Hardening, NothingThatIsNoNumberIsWritten) {
  for (const char* thickness : {"1e-320", "1e-100", "1e-20", "1e20", "1e59"}) {
    for (const char* force : {"1e59", "1e-320", "1e20"}) {
      write("extreme.toml", model("[studies.push]\nkind = \"path\"\nsteps = 2\nmodelings = "
                                  "[\"linear\", \"scmbm\", \"prbm\", \"exact\", \"beam\"]\n"
                                  "loads = [{ on = \"stage.P\", force = [" +
                                      std::string(force) +
                                      ", 0.0] }]\n[studies.ellipse]\n"
                                      "kind = \"linear\"\n",
                                  thickness));
      run("run extreme.toml -q -o extreme");
      EXPECT_TRUE(answer_.status == 0 || answer_.status == 1) << answer_.text;
      if (!fs::exists(top_ / "extreme")) continue;
      for (const auto& entry : fs::recursive_directory_iterator(top_ / "extreme")) {
        if (entry.path().extension() != ".csv" && entry.path().extension() != ".json") continue;
        std::string text = read(fs::relative(entry.path(), top_).string());
        for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        for (const char* word : {",nan", ",inf", ",-inf", ",-nan", ": nan", ": inf"})
          EXPECT_EQ(text.find(word), std::string::npos)
              << thickness << ' ' << force << ' ' << entry.path() << ' ' << word;
      }
      fs::remove_all(top_ / "extreme");
    }
  }
}

TEST_F(Hardening, MillionsOfEverythingAreRefusedWithTheLimit) {
  write("many.toml",
        model("[studies.a]\nkind = \"path\"\nsteps = 9223372036854775807\nmodelings = [{ name = "
              "\"beam\", elements = 2000000000 }, { name = \"exact\", modes = 1000000 }, { name = "
              "\"continuum\", elements = 100000, across = 1000, order = 8 }]\n"
              "loads = [{ on = \"stage\", force = [1, 0] }]\n"
              "[studies.b]\nkind = \"buckling\"\ncount = 1000000000\nmodelings = [\"exact\"]\n"
              "loads = [{ on = \"stage\", force = [1, 0] }]\n"));
  run("check many.toml");
  expect(2, "many.toml:27:9: error: studies.a.steps: must lie between 1 and 100000");
  expect(2, "elements: must lie between 1 and 100000");
  expect(2, "modes: must lie between 2 and 32");
  expect(2, "3 million are the most");
  expect(2, "studies.b.count: must lie between 1 and 1000");
}

TEST_F(Hardening, NamesOfAnyLengthDoNotFloodMessages) {
  std::string text = model("");
  text.replace(text.find("[materials.steel]"), 17, "[materials." + std::string(100000, 'y') + "]");
  write("long.toml", text);
  run("check long.toml");
  expect(2, "unknown material 'steel'");
  EXPECT_LT(answer_.text.size(), 2000U);
}

}  // namespace
}  // namespace flexura

#include "flexura/io/write_results.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <set>
#include <string>

#include "tests/report/sample_motion.hpp"
#include "tests/report/sample_result.hpp"
#include "tests/support/folder_test.hpp"

namespace flexura {
namespace {

namespace fs = std::filesystem;

class WriteResults : public testing::FolderTest {
 protected:
  /// Everything below the test's folder, as relative names.
  std::set<std::string> content() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(top_)) {
      if (!entry.is_directory()) names.insert(fs::relative(entry.path(), top_).string());
    }
    return names;
  }

  const Result result_ = sample::make_sample_result();
};

TEST_F(WriteResults, WritesTheFilesOfTheContract) {
  ASSERT_EQ(write_results(result_, "<html>", top_ / "new" / "chain.results").error, "");
  const std::set<std::string> names = content();
  const std::string folder = "new/chain.results/";
  for (const char* name : {"summary.json", "report.html", "push/linear.csv", "push/exact.csv",
                           "push/exact.members.csv", "lift & turn/scmbm.csv", "hold/prbm.csv",
                           "ellipses/ellipse.json"}) {
    EXPECT_TRUE(names.contains(folder + name)) << name;
  }
  for (const char* name :
       {"push/continuum.fields.vtu", "lift & turn/continuum.fields.000.vtu",
        "lift & turn/continuum.fields.020.vtu", "lift & turn/continuum.fields.pvd"}) {
    EXPECT_TRUE(names.contains(folder + name)) << name;
  }
  EXPECT_EQ(names.size(), 2U + 20U + 10U + 8U + 1U + 1U + 22U);
  EXPECT_EQ(read(top_ / folder / "report.html"), "<html>");
}

TEST_F(WriteResults, WritesTheFilesOfMotions) {
  ASSERT_EQ(write_results(sample::make_sample_motion(), "<html>", top_).error, "");
  const std::set<std::string> names = content();
  for (const char* name : {"sing/exact.modes.csv", "sing/exact.shapes.csv",
                           "sing/exact.frequencies.csv", "turn/scmbm.csv", "turn/scmbm.energy.csv",
                           "turn/scmbm.members.csv", "shake/prbm.response.csv"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  EXPECT_EQ(names.size(), 2U + 9U + 12U + 3U + 3U);
}

TEST_F(WriteResults, NamesTheFilesOfModesByTheirKind) {
  Result result = sample::make_sample_motion();
  result.studies.resize(1);
  result.studies[0].kind = "buckling";
  auto& modes = std::get<ModeResult>(result.studies[0].content);
  modes.modelings.resize(1);
  modes.modelings[0].curve.clear();
  ASSERT_EQ(write_results(result, "<html>", top_).error, "");
  EXPECT_EQ(content(), (std::set<std::string>{"report.html", "sing/prbm.buckling.csv",
                                              "sing/prbm.shapes.csv", "summary.json"}));
}

TEST_F(WriteResults, ReplacesOldResultsAndKeepsOtherFiles) {
  std::ofstream(top_ / "report.html") << "old";
  std::ofstream(top_ / "notes.txt") << "mine";
  ASSERT_TRUE(write_results(result_, "new", top_).ok());
  EXPECT_EQ(read(top_ / "report.html"), "new");
  EXPECT_EQ(read(top_ / "notes.txt"), "mine");
}

TEST_F(WriteResults, SaysWhereItCannotWrite) {
  std::ofstream(top_ / "file") << "in the way";
  const fs::path folder = top_ / "file" / "results";
  const WriteOutcome outcome = write_results(result_, "", folder);
  EXPECT_EQ(outcome.error.find("Cannot write '" + (top_ / "file").string()), 0U) << outcome.error;
  EXPECT_EQ(content(), std::set<std::string>{"file"});
}

TEST_F(WriteResults, LeavesNothingHalfWrittenWhenTheDiskIsFull) {
  std::ofstream(top_ / "report.html") << "old";
  // A limit on the size of files stands for a full disk: small ones pass, a large one fails.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit limited = before;
  limited.rlim_cur = 400'000;
  setrlimit(RLIMIT_FSIZE, &limited);
  const WriteOutcome outcome = write_results(result_, std::string(500'000, 'x'), top_);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_NE(outcome.error.find("report.html"), std::string::npos) << outcome.error;
  EXPECT_NE(outcome.error.find("File too large"), std::string::npos) << outcome.error;
  EXPECT_EQ(content(), std::set<std::string>{"report.html"});
  EXPECT_EQ(read(top_ / "report.html"), "old");
  EXPECT_FALSE(fs::exists(top_ / "push"));
}

TEST_F(WriteResults, TouchesNothingWhenAFolderIsInTheWay) {
  fs::create_directories(top_ / "report.html");
  const WriteOutcome outcome = write_results(result_, "", top_);
  EXPECT_NE(outcome.error.find("a folder of that name is in the way"), std::string::npos);
  EXPECT_TRUE(content().empty());
}

TEST_F(WriteResults, RefusesValuesThatAreNoNumbers) {
  Result result = result_;
  std::get<PathResult>(result.studies[0].content).modelings[3].states[2].points[0].x = std::nan("");
  const WriteOutcome outcome = write_results(result, "", top_);
  EXPECT_EQ(outcome.error,
            "Cannot write 'push/exact.csv': row 2: link4.E.x is not a finite number.");
  EXPECT_TRUE(content().empty());
}

TEST_F(WriteResults, RefusesNamesThatLeaveTheFolder) {
  for (const char* name : {"../elsewhere", "a/b", "..", "", ".hidden"}) {
    Result result = result_;
    std::get<PathResult>(result.studies[0].content).modelings[0].label = name;
    EXPECT_FALSE(write_results(result, "", top_).ok()) << name;
    result = result_;
    result.studies[3].name = name;
    EXPECT_FALSE(write_results(result, "", top_).ok()) << name;
  }
  EXPECT_TRUE(content().empty());
}

TEST_F(WriteResults, RefusesTwoResultsOfOneName) {
  Result result = result_;
  std::get<PathResult>(result.studies[0].content).modelings[0].label = "exact";
  EXPECT_NE(write_results(result, "", top_).error.find("'push/exact.csv'"), std::string::npos);
  EXPECT_TRUE(content().empty());
}

}  // namespace
}  // namespace flexura

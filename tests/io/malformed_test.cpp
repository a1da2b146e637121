// Every file in tests/data/malformed states in its header what must be said about it:
//
//     # expect: line:column: part of the message
//
// one line for each diagnostic, in order. A new case is a new file.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "flexura/io/model_reader.hpp"
#include "tests/io/model_text.hpp"

namespace flexura {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> malformed_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(FLEXURA_SOURCE_DIR "/tests/data/malformed")) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

struct Expectation {
  std::string position;  // "7:13"
  std::string message;
};

std::vector<Expectation> expectations_of(const fs::path& file) {
  const std::string marker = "# expect: ";
  std::vector<Expectation> expectations;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line) && line.starts_with(marker);) {
    const auto end = line.find(": ", marker.size());
    expectations.push_back({line.substr(marker.size(), end - marker.size()), line.substr(end + 2)});
  }
  return expectations;
}

class Malformed : public ::testing::TestWithParam<fs::path> {};

TEST_P(Malformed, SaysWhatIsWrongAndWhere) {
  const auto expected = expectations_of(GetParam());
  ASSERT_FALSE(expected.empty()) << "the file does not say what to expect";
  const ModelReading reading = read_model(GetParam());
  EXPECT_FALSE(reading.model.has_value());
  ASSERT_EQ(reading.diagnostics.size(), expected.size()) << testing::messages(reading.diagnostics);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Diagnostic& found = reading.diagnostics[i];
    EXPECT_EQ(std::to_string(found.position.line) + ":" + std::to_string(found.position.column),
              expected[i].position)
        << found.message;
    EXPECT_NE(found.message.find(expected[i].message), std::string::npos) << found.message;
  }
}

INSTANTIATE_TEST_SUITE_P(Files, Malformed, ::testing::ValuesIn(malformed_files()),
                         [](const auto& file) { return file.param.stem().string(); });

TEST(MalformedFiles, AreManyEnough) { EXPECT_GE(malformed_files().size(), 100u); }

}  // namespace
}  // namespace flexura

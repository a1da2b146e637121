// Files that are no models at all: none may crash the reader, hang it or be read as a model.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "flexura/io/model_reader.hpp"
#include "tests/io/model_text.hpp"

namespace flexura {
namespace {

namespace fs = std::filesystem;

void expect_refused(const ModelReading& reading, SourcePosition position,
                    const std::string& message) {
  EXPECT_FALSE(reading.model.has_value());
  ASSERT_EQ(reading.diagnostics.size(), 1u) << testing::messages(reading.diagnostics);
  EXPECT_EQ(reading.diagnostics[0].position, position);
  EXPECT_NE(reading.diagnostics[0].message.find(message), std::string::npos)
      << reading.diagnostics[0].message;
}

std::string repeat(const std::string& part, std::size_t times) {
  std::string text;
  text.reserve(part.size() * times);
  for (std::size_t i = 0; i < times; ++i) text += part;
  return text;
}

TEST(HostileFile, MissingFile) {
  expect_refused(read_model("/nonexistent/model.toml"), {}, "No such file");
}

TEST(HostileFile, Directory) {
  expect_refused(read_model(fs::temp_directory_path()), {}, "directory");
}

TEST(HostileFile, TenMegabytes) {
  const fs::path file = fs::temp_directory_path() / "flexura_ten_megabytes.toml";
  std::ofstream(file) << std::string(10 * 1024 * 1024, '#');
  expect_refused(read_model(file), {}, "10.0 MB; a model file may have 4 MB");
  fs::remove(file);
}

TEST(HostileFile, EndlessDevice) {
  if (fs::exists("/dev/zero")) expect_refused(read_model("/dev/zero"), {}, "4 MB at most");
}

TEST(HostileFile, Binary) {
  using namespace std::string_literals;
  expect_refused(read_model_text("flexura = 1\n\x7F"
                                 "ELF\0\0"s),
                 {2, 5}, "binary file");
  expect_refused(read_model_text("title = \"caf\xE9\"\n"), {1, 13}, "not UTF-8 text (byte 0xe9");
  expect_refused(read_model_text("\xFF\xFE"
                                 "f\0l\0"s),
                 {}, "UTF-16");
  expect_refused(read_model_text("a = \"\xED\xA0\x80\"\n"), {1, 6}, "not UTF-8");  // a surrogate
  expect_refused(read_model_text("a = \"\xC0\xAF\"\n"), {1, 6}, "not UTF-8");      // overlong
  expect_refused(read_model_text("a = \"\xF4\x90\x80\x80\"\n"), {1, 6}, "not UTF-8");
}

TEST(HostileFile, ColumnsCountCharacters) {
  expect_refused(read_model_text("title = \"\u00e4\u00f6\u00fc\xFF\"\n"), {1, 13}, "0xff");
}

TEST(HostileFile, DeepNesting) {
  expect_refused(read_model_text("flexura = 1\na = " + std::string(100000, '[')), {2, 37},
                 "nested deeper");
  expect_refused(read_model_text("a = " + repeat("{ a = ", 100000)), {1, 197}, "nested deeper");
  expect_refused(read_model_text("[" + repeat("a.", 1000000) + "a]\n"), {1, 33}, "parts");
  expect_refused(read_model_text(repeat("'a' . ", 1000) + "a = 1\n"), {1, 95}, "parts");
}

TEST(HostileFile, BracketsAndDotsInTextsAndCommentsDoNotCount) {
  testing::ModelText model;
  model.head += "title = \"" + std::string(50, '[') + repeat("a.", 50) + "\\\"[\"  # " +
                std::string(50, '{') + repeat("...", 50) + "\n";
  EXPECT_TRUE(read_model_text(model.text()).model.has_value());
}

TEST(HostileFile, LongExpression) {
  testing::ModelText model;
  model.sections = "[sections.strip]\nrectangle = { thickness = \"= " + repeat("(", 100000) +
                   "\", width = 1.0 }\n";
  const ModelReading reading = read_model_text(model.text());
  ASSERT_EQ(reading.diagnostics.size(), 1u);
  EXPECT_LT(reading.diagnostics[0].message.size(), 300u);
}

TEST(HostileFile, ManyMistakesEndSoon) {
  testing::ModelText model;
  for (int i = 0; i < 20000; ++i) {
    const std::string n = std::to_string(i);
    model.studies += "[flexures.f" + n + "]\nbetween = [\"b" + n + "\", \"c" + n + "\"]\n";
  }
  EXPECT_EQ(read_model_text(model.text()).diagnostics.size(), 5u * 20000u);
}

TEST(HostileFile, ByteOrderMarkAndWindowsLineEndsAreFine) {
  std::string text = testing::ModelText().text();
  for (auto at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2)) {
    text.insert(at, "\r");
  }
  EXPECT_TRUE(read_model_text("\xEF\xBB\xBF" + text).model.has_value());
}

}  // namespace
}  // namespace flexura

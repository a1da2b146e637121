#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace flexura::testing {

/// A folder of the test's own, gone afterwards.
class FolderTest : public ::testing::Test {
 protected:
  FolderTest()
      : top_(std::filesystem::temp_directory_path() /
             ("flexura_" +
              std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) +
              std::to_string(::getpid()))) {
    std::filesystem::remove_all(top_);
    std::filesystem::create_directories(top_);
  }
  ~FolderTest() override { std::filesystem::remove_all(top_); }

  std::string read(const std::filesystem::path& name) const {
    std::ifstream stream(top_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  const std::filesystem::path top_;
};

}  // namespace flexura::testing

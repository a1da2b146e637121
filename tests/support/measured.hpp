#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace flexura::testing {

/// Notes a measured error in the test's record (--gtest_output=xml), beside what it must not
/// exceed.
inline void note_measured(const std::string& what, double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2e", value);
  ::testing::Test::RecordProperty(what, text);
}

}  // namespace flexura::testing

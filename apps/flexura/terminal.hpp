#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "flexura/core/diagnostics.hpp"
#include "flexura/core/progress.hpp"

namespace flexura::app {

/// Colours only where a person looks: the stream is a terminal and NO_COLOR is not set.
bool is_coloured(int file_descriptor);

/// One line per diagnostic, `file:line:column: error: message` (or `warning:`), on standard error.
void print_diagnostics(const std::string& file, const Diagnostics& diagnostics);

/// One `flexura: error: message` line on standard error.
void print_error(const std::string& message);

/// A progress line that comes up after a second, on a terminal only, and is wiped when done.
class ProgressLine {
 public:
  explicit ProgressLine(bool shown);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void update(const ProgressReport& report);

 private:
  bool shown_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace flexura::app

#include "apps/flexura/terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace flexura::app {

bool is_coloured(int file_descriptor) {
  const char* no_color = std::getenv("NO_COLOR");
  return isatty(file_descriptor) != 0 && (no_color == nullptr || *no_color == '\0');
}

void print_diagnostics(const std::string& file, const Diagnostics& diagnostics) {
  const bool coloured = is_coloured(STDERR_FILENO);
  const char* red = coloured ? "\033[1;31m" : "";
  const char* magenta = coloured ? "\033[1;35m" : "";
  const char* plain = coloured ? "\033[0m" : "";
  for (const Diagnostic& d : diagnostics) {
    const bool is_error = d.severity == Severity::error;
    fmt::print(stderr, "{}:{}:{}: {}{}:{} {}\n", file, d.position.line, d.position.column,
               is_error ? red : magenta, is_error ? "error" : "warning", plain, d.message);
  }
}

void print_error(const std::string& message) {
  fmt::print(stderr, "flexura: error: {}\n", message);
}

ProgressLine::ProgressLine(bool shown)
    : shown_(shown && isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()),
      last_(start_) {}

ProgressLine::~ProgressLine() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
}

void ProgressLine::update(const ProgressReport& report) {
  using namespace std::chrono_literals;
  const auto now = std::chrono::steady_clock::now();
  if (!shown_ || now - start_ < 1s || now - last_ < 100ms) return;
  last_ = now;
  drawn_ = true;
  const std::chrono::duration<double> elapsed = now - start_;
  fmt::print(stderr, "\r\033[K{:<24} {:<16} {:3.0f} %  {:.0f} s", report.study, report.label,
             100.0 * report.fraction, elapsed.count());
  std::fflush(stderr);
}

}  // namespace flexura::app

#include "apps/flexura/watched_run.hpp"

#include <atomic>
#include <csignal>
#include <utility>

#include "apps/flexura/terminal.hpp"

namespace flexura::app {
namespace {

std::atomic<bool> interrupted = false;

}  // namespace

Result run_watched(const Model& model, RunOptions options, bool quiet) {
  std::signal(SIGINT, [](int) { interrupted = true; });
  ProgressLine line(!quiet);
  options.progress = [&line](const ProgressReport& report) {
    line.update(report);
    return !interrupted;
  };
  return run_studies(model, options);
}

}  // namespace flexura::app

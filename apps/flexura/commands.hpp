#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace flexura::app {

/// Exit status of every command.
inline constexpr int all_finished = 0;
inline constexpr int stopped_early = 1;
inline constexpr int wrong_input = 2;

struct ModelArguments {
  std::filesystem::path file;
  std::vector<std::string> assignments;  ///< --set name=value
};

struct RunArguments {
  ModelArguments model;
  std::filesystem::path output;  ///< empty: <model>.results beside the working folder
  std::vector<std::string> studies;
  std::vector<std::string> modelings;
  int threads = 0;
  bool quiet = false;
};

int run_command(const RunArguments& arguments);
int check_command(const ModelArguments& arguments, bool quiet);
int new_command(const std::filesystem::path& file);

}  // namespace flexura::app

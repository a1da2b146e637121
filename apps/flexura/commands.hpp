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

struct DrawArguments {
  ModelArguments model;
  std::filesystem::path output;  ///< empty: <model>.svg beside the working folder
  std::string study;             ///< empty: the first that has a shape to draw
  std::string modeling;          ///< label or name; empty: the study's reference
  int mode = 1;
  double exaggeration = 0.0;  ///< 0: as the eye needs it
  bool still = false;
  bool quiet = false;
};

int run_command(const RunArguments& arguments);
int check_command(const ModelArguments& arguments, bool quiet);
int draw_command(const DrawArguments& arguments);
int new_command(const std::filesystem::path& file);

}  // namespace flexura::app

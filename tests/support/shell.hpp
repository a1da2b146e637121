#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace flexura::testing {

/// What a command line printed on standard output, and its exit status; -1 if it has none.
struct ShellAnswer {
  int status = -1;
  std::string text;
};

inline ShellAnswer ask_shell(const std::string& command) {
  ShellAnswer answer;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return answer;
  std::array<char, 4096> block{};
  for (std::size_t n = 0; (n = std::fread(block.data(), 1, block.size(), pipe)) > 0;)
    answer.text.append(block.data(), n);
  const int status = pclose(pipe);
  if (WIFEXITED(status)) answer.status = WEXITSTATUS(status);
  return answer;
}

}  // namespace flexura::testing

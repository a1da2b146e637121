// What the command says to motions that cannot be computed: what is wrong with what, where, and
// exit status 2.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace flexura {
namespace {

struct Answer {
  std::string text;
  int status = -1;
};

Answer answer_to(const std::string& command) {
  Answer answer;
  FILE* pipe = popen((command + " 2>&1 </dev/null").c_str(), "r");
  if (!pipe) return answer;
  std::array<char, 4096> block{};
  for (std::size_t n = 0; (n = fread(block.data(), 1, block.size(), pipe)) > 0;)
    answer.text.append(block.data(), n);
  const int status = pclose(pipe);
  if (WIFEXITED(status)) answer.status = WEXITSTATUS(status);
  return answer;
}

struct Refusal {
  const char* file;
  const char* place;
  const char* message;
};

class RefusedMotion : public ::testing::TestWithParam<Refusal> {};

TEST_P(RefusedMotion, IsToldOfByTheCommand) {
  const auto& [name, place, message] = GetParam();
  const std::string file =
      std::string(FLEXURA_SOURCE_DIR "/tests/data/malformed/") + name + ".toml";
  for (const char* verb : {"check", "run"}) {
    const Answer answer =
        answer_to(std::string("'" FLEXURA_EXECUTABLE "' ") + verb + " '" + file + "'");
    EXPECT_EQ(answer.status, 2) << verb << ": " << answer.text;
    const std::size_t at = answer.text.find(std::string(name) + ".toml:" + place + ": ");
    ASSERT_NE(at, std::string::npos) << verb << ": " << answer.text;
    const std::string line = answer.text.substr(at, answer.text.find('\n', at) - at);
    EXPECT_NE(line.find(message), std::string::npos) << line;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Files, RefusedMotion,
    ::testing::Values(
        Refusal{"motion_without_density", "8:12", "material 'steel' of flexure 'leaf' needs a"},
        Refusal{"history_values", "41:31", "the table ends at time 2, before the study does at 5"},
        Refusal{"history_file", "40:31", "the table ends at time 1, before the study does at 5"},
        Refusal{"transient_mistakes", "44:8", "studies.a.step: a time step of zero gets nowhere"},
        Refusal{"joint_redundant", "25:9", "joint 'guide' holds again what joint 'rail' holds"}),
    [](const auto& tested) { return tested.param.file; });

}  // namespace
}  // namespace flexura

// Random mechanisms by the thousand: each is solved by modeling `exact` as `flexura run` would, and
// what is said of its end is looked into. Exit status 0 where enough of that is right.
//   build/release/robustness/flexura_robustness [--count N] [--seed FIRST]
//   build/release/robustness/flexura_robustness --one SEED.. [--write MODEL.toml]
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <vector>

#include "robustness/verdict.hpp"

namespace {

using namespace flexura::robustness;

constexpr std::uint64_t compared_share = 10;  // one in so many, by its seed
constexpr std::uint64_t threads_share = 50;
constexpr double least_correct = 0.999;

const char* name_of(Verdict::End end) {
  if (end == Verdict::End::reached) return "full load";
  if (end == Verdict::End::wound_up) return "wound up";
  return end == Verdict::End::limit_point ? "limit point" : "failed";
}

std::string describe(const RandomMechanism& mechanism, const Verdict& verdict) {
  std::string text =
      fmt::format("seed {}: {}, slenderness {:.0f}, load {:.3g}: {} at load factor {:.6g}{}",
                  mechanism.seed, mechanism.family, mechanism.slenderness, mechanism.load,
                  name_of(verdict.end), verdict.load_factor, verdict.unstable ? ", unstable" : "");
  if (!verdict.correct) text += fmt::format("\n  {}: {}", verdict.category, verdict.reason);
  if (!verdict.comparison_note.empty()) text += "\n  " + verdict.comparison_note;
  return text;
}

struct Tally {
  std::size_t reached = 0, limits = 0, wound = 0, failed = 0, correct = 0, unstable = 0;
  std::size_t compared = 0, agree = 0, other_branch = 0;
  std::map<std::string, int> categories;

  void add(const Verdict& verdict) {
    ++(verdict.end == Verdict::End::reached       ? reached
       : verdict.end == Verdict::End::limit_point ? limits
       : verdict.end == Verdict::End::wound_up    ? wound
                                                  : failed);
    correct += verdict.correct ? 1 : 0;
    unstable += verdict.unstable ? 1 : 0;
    if (!verdict.correct) ++categories[verdict.category];
    if (verdict.comparison == Verdict::Comparison::none) return;
    ++compared;
    agree += verdict.comparison == Verdict::Comparison::agrees ? 1 : 0;
    other_branch += verdict.comparison == Verdict::Comparison::other_branch ? 1 : 0;
  }
};

void print(const Tally& tally, std::size_t count) {
  const auto line = [count](const char* what, std::size_t number) {
    fmt::print("{:<52} {:>6}  {:7.3f} %\n", what, number,
               100.0 * static_cast<double>(number) / static_cast<double>(count));
  };
  line("full load reached", tally.reached);
  line("limit point, passed by arc length", tally.limits);
  line("flexures wound up by 3 turns, in equilibrium", tally.wound);
  line("failed", tally.failed);
  line("correct", tally.correct);
  line("of all, ended on an unstable stretch of their path", tally.unstable);
  fmt::print("compared with elements of order 7: {}; alike {}, elements on another branch {}\n",
             tally.compared, tally.agree, tally.other_branch);
  for (const auto& [category, number] : tally.categories)
    fmt::print("not correct: {}: {}\n", category, number);
}

int run_single(const std::vector<std::uint64_t>& seeds, const std::string& file) {
  bool correct = true;
  for (const std::uint64_t seed : seeds) {
    const RandomMechanism mechanism = make_random_mechanism(seed);
    if (!file.empty()) std::ofstream(file) << write_model(mechanism);
    const Verdict verdict = judge(mechanism, {true});
    fmt::print("{}\n{:.1f} ms\n", describe(mechanism, verdict), 1e3 * verdict.seconds);
    correct = correct && verdict.correct;
  }
  return correct ? 0 : 1;
}

int run_many(std::uint64_t first, std::size_t count) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<Verdict> verdicts(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
    const std::uint64_t seed = first + k;
    verdicts[k] = judge(make_random_mechanism(seed), {seed % compared_share == 0});
  });
  Tally tally;
  for (std::size_t k = 0; k < count; ++k) {
    tally.add(verdicts[k]);
    if (!verdicts[k].correct || !verdicts[k].comparison_note.empty())
      fmt::print("{}\n", describe(make_random_mechanism(first + k), verdicts[k]));
  }
  std::size_t asked = 0, same = 0;
  for (std::uint64_t seed = first; seed < first + count; seed += threads_share, ++asked)
    if (is_independent_of_threads(make_random_mechanism(seed)))
      ++same;
    else
      fmt::print("seed {}: not the same on one thread and on two\n", seed);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  print(tally, count);
  fmt::print("the same to the last bit on one thread and on two: {} of {}\n", same, asked);
  fmt::print("{} mechanisms in {:.1f} s\n", count, took.count());
  const double share = static_cast<double>(tally.correct) / static_cast<double>(count);
  return share >= least_correct && same == asked ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Solves random mechanisms and looks into how they end.", "flexura_robustness");
  std::size_t count = 10000;
  std::uint64_t first = 1;
  std::vector<std::uint64_t> single;
  std::string file;
  app.add_option("--count", count, "so many mechanisms (default 10000)");
  app.add_option("--seed", first, "the first one's seed (default 1); the others follow");
  app.add_option("--one", single, "the mechanism of this seed only, or of several, each compared");
  app.add_option("--write", file, "write that mechanism (the last one) as a model file");
  CLI11_PARSE(app, argc, argv);
  return single.empty() ? run_many(first, count) : run_single(single, file);
}

#pragma once

#include <string>

#include "robustness/random_mechanism.hpp"

namespace flexura::robustness {

/// How a path ended, and what was found when that was looked into.
struct Verdict {
  enum class End { reached, limit_point, wound_up, failed };
  /// What a second solution by high-order beam elements says.
  enum class Comparison { none, agrees, other_branch, differs };

  End end = End::failed;
  bool correct = false;
  bool unstable = false;  ///< a bifurcation was passed on the way
  double load_factor = 0.0;
  double seconds = 0.0;
  std::string category;  ///< of what is not correct, in few words
  std::string reason;    ///< in a sentence
  Comparison comparison = Comparison::none;
  std::string comparison_note;
};

struct JudgeOptions {
  bool compare = false;  ///< solve by beam elements, too
};

/// Solves the mechanism by modeling `exact` as study `path` does, and looks into the end: a state
/// at full load or with flexures wound up must be an equilibrium, and a limit point must be passed
/// by arc length.
Verdict judge(const RandomMechanism& mechanism, const JudgeOptions& options);

/// Whether the study's result on one thread and on two are the same to the last bit.
bool is_independent_of_threads(const RandomMechanism& mechanism);

}  // namespace flexura::robustness

#pragma once

#include <string>
#include <vector>

namespace flexura {

/// A place in the model file, counted from 1. (1, 1) where nothing is nearer.
struct SourcePosition {
  int line = 1;
  int column = 1;

  // clang-tidy 14 takes the defaulted comparison for a null pointer
  friend auto operator<=>(const SourcePosition&, const SourcePosition&) = default;  // NOLINT
};

/// An error makes a model unusable; a warning says that it is hardly what was meant.
enum class Severity { error, warning };

/// One mistake in a model file: what was wrong, with the offending value and the nearest valid
/// choice in the sentence.
struct Diagnostic {
  SourcePosition position;
  std::string message;
  Severity severity = Severity::error;
};

using Diagnostics = std::vector<Diagnostic>;

}  // namespace flexura

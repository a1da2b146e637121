#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexura {

/// Formulas of named numbers: + - * / ^, comparisons, `a ? b : c`, the usual functions (sin, cos,
/// tan, asin, acos, atan, atan2, sinh, cosh, tanh, sqrt, exp, ln, log10, log2, abs, sign, rint,
/// min, max, sum, avg; trigonometric ones in radians) and `pi`. Independent of the locale.
class Formulas {
 public:
  Formulas();
  ~Formulas();
  Formulas(Formulas&&) noexcept;
  Formulas& operator=(Formulas&&) noexcept;

  /// Why `name` cannot name a number; nothing if it can.
  std::optional<std::string> check_name(const std::string& name) const;

  /// Makes the number known to all later formulas. Precondition: check_name has no objection.
  void define(const std::string& name, double value);

  struct Names {
    std::vector<std::string> names;
    std::string error;  ///< empty if the formula reads well
  };
  /// The names in a formula that are not defined yet.
  Names undefined_names(const std::string& formula) const;

  struct Value {
    std::optional<double> value;
    std::string error;
  };
  /// The value, if it is finite. Precondition: no name in it is undefined.
  Value evaluate(const std::string& formula) const;

  struct Function {
    std::function<double(double)> function;
    std::string error;  ///< empty if the formula reads well
  };
  /// The formula as a function of one more name, which hides a number of that name. Threads may
  /// call it at once; copies share nothing, and do not wait for one another. What cannot be
  /// evaluated is not a number.
  /// Precondition: no other name in it is undefined.
  Function function_of(const std::string& variable, const std::string& formula) const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

/// The formula in "= 2*t + 0.1", with a space for its "="; nothing if the text begins otherwise.
std::optional<std::string> formula_of(std::string_view text);

}  // namespace flexura

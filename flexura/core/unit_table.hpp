#pragma once

#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flexura/core/units.hpp"

namespace flexura {

/// The constants a Scale counts, all exact but pi: an inch is 254e-4 m, a pound 45359237e-8 kg,
/// standard gravity 980665e-5 m/s^2, a degree pi/(18e1).
enum class UnitConstant { two, twelve, eighteen, sixty, inch, pound, gravity, pi };
inline constexpr std::array<double, 8> unit_constants = {
    2.0, 12.0, 18.0, 60.0, 254.0, 45359237.0, 980665.0, std::numbers::pi};

/// Product of two scales.
constexpr Scale operator+(Scale a, const Scale& b) {
  a.decimal += b.decimal;
  for (std::size_t i = 0; i < a.constants.size(); ++i) a.constants[i] += b.constants[i];
  return a;
}

/// A scale to a power.
constexpr Scale operator*(int power, Scale a) {
  a.decimal *= power;
  for (int& exponent : a.constants) exponent *= power;
  return a;
}

/// Powers of ten.
constexpr Scale ten(int decimal) { return {decimal, {}}; }

/// The unit of one word of the grammar in units.hpp, prefix included.
std::optional<Unit> find_unit_word(std::string_view word);

/// Words to suggest where one is misspelt.
const std::vector<std::string>& unit_words();

}  // namespace flexura

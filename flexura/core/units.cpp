#include "flexura/core/units.hpp"

#include <charconv>
#include <cmath>
#include <limits>

#include "flexura/core/nearest_word.hpp"
#include "flexura/core/unit_table.hpp"

namespace flexura {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_word_char(char c) {
  // Bytes above 127 belong to µ, ° and whatever else then is an unknown word.
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) > 127;
}

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// Reads the grammar in the header from left to right.
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : text_(text) {}

  UnitReading read() {
    const bool divides = text_.front() == '/';
    if (divides) {
      ++at_;
      skip_spaces();
    }
    if (!read_factor(divides ? -1 : 1)) return {std::nullopt, error_};
    while (true) {
      const bool space = skip_spaces();
      if (rest().empty()) return {unit_, ""};
      const char c = rest().front();
      const bool is_operator = c == '*' || c == '/';
      if (!is_operator && !space) return {std::nullopt, unexpected()};
      if (is_operator) ++at_;
      skip_spaces();
      if (!read_factor(c == '/' ? -1 : 1)) return {std::nullopt, error_};
    }
  }

 private:
  std::string_view rest() const { return text_.substr(at_); }

  bool skip_spaces() {
    const std::size_t before = at_;
    while (!rest().empty() && (rest().front() == ' ' || rest().front() == '\t')) ++at_;
    return at_ != before;
  }

  std::string unexpected() const {
    if (rest().empty()) return "the unit '" + std::string(text_) + "' is not complete";
    return "unexpected '" + std::string(rest()) + "' in the unit '" + std::string(text_) + "'";
  }

  bool read_factor(int sign) {
    std::size_t length = 0;
    while (length < rest().size() && is_word_char(rest()[length])) {
      // A superscript ends the word.
      if (length > 0 && superscript(rest().substr(length)) != 0) break;
      ++length;
    }
    if (length == 0) {
      error_ = unexpected();
      return false;
    }
    const std::string_view word = rest().substr(0, length);
    const auto unit = find_unit_word(word);
    if (!unit) {
      error_ = "unknown unit '" + std::string(word) + "'" + suggestion(word, unit_words());
      return false;
    }
    at_ += length;
    const auto power = read_power();
    if (!power) {
      error_ = unexpected();
      return false;
    }
    multiply(*unit, sign * *power);
    return true;
  }

  static int superscript(std::string_view text) {
    if (text.starts_with("\u00b2")) return 2;
    if (text.starts_with("\u00b3")) return 3;
    return 0;
  }

  std::optional<int> read_power() {
    if (const int power = superscript(rest())) {
      at_ += 2;
      return power;
    }
    const bool caret = !rest().empty() && rest().front() == '^';
    std::size_t at = at_ + (caret ? 1 : 0);
    const bool negative = at < text_.size() && text_[at] == '-';
    if (negative) ++at;
    if (at == text_.size() || !is_digit(text_[at])) {
      return caret || negative ? std::nullopt : std::optional(1);
    }
    const int power = text_[at] - '0';
    if (power == 0 || (at + 1 < text_.size() && is_digit(text_[at + 1]))) return std::nullopt;
    at_ = at + 1;
    return negative ? -power : power;
  }

  void multiply(const Unit& unit, int power) {
    unit_.dimension.length += power * unit.dimension.length;
    unit_.dimension.mass += power * unit.dimension.mass;
    unit_.dimension.time += power * unit.dimension.time;
    unit_.dimension.angle += power * unit.dimension.angle;
    unit_.scale = unit_.scale + power * unit.scale;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  Unit unit_;
  std::string error_;
};

/// Length of the decimal number at the start of `text`, 0 if there is none.
std::size_t number_length(std::string_view text) {
  const std::size_t sign = !text.empty() && (text[0] == '+' || text[0] == '-') ? 1 : 0;
  std::size_t at = sign;
  std::size_t digits = 0;
  bool point = false;
  for (; at < text.size() && (is_digit(text[at]) || (text[at] == '.' && !point)); ++at) {
    if (text[at] == '.') {
      point = true;
    } else {
      ++digits;
    }
  }
  if (digits == 0) return 0;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t exponent = at + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    const std::size_t first = exponent;
    while (exponent < text.size() && is_digit(text[exponent])) ++exponent;
    if (exponent > first) at = exponent;
  }
  return at;
}

/// Precondition: `number` is what number_length accepts.
double value_of_digits(std::string_view number, int decimal) {
  std::string text(number.substr(number.front() == '+' ? 1 : 0));
  const auto e = text.find_first_of("eE");
  long exponent = 0;
  if (e != std::string::npos) {
    const std::size_t first = e + (text[e + 1] == '+' ? 2 : 1);
    const auto status =
        std::from_chars(text.data() + first, text.data() + text.size(), exponent).ec;
    if (status != std::errc{}) return std::numeric_limits<double>::infinity();
    text.resize(e);
  }
  text += "e" + std::to_string(exponent + decimal);
  double value = 0.0;
  const auto status = std::from_chars(text.data(), text.data() + text.size(), value).ec;
  return status == std::errc{} ? value : std::numeric_limits<double>::infinity();
}

}  // namespace

UnitReading read_unit(std::string_view text) {
  constexpr std::size_t longest_unit = 80;  // far beyond any real one; bounds the exponents
  text = trim(text);
  if (text.empty()) return {std::nullopt, "there is no unit"};
  if (text.size() > longest_unit) return {std::nullopt, "the unit is too long"};
  return UnitParser(text).read();
}

QuantityReading read_quantity(std::string_view text) {
  text = trim(text);
  const std::size_t length = number_length(text);
  if (length == 0) return {std::nullopt, "it does not begin with a number"};
  const std::string_view unit_text = trim(text.substr(length));
  if (unit_text.empty()) {
    return {std::nullopt, "it has no unit; numbers in the declared units stand without quotes"};
  }
  UnitReading reading = read_unit(unit_text);
  if (!reading.unit) return {std::nullopt, std::move(reading.error)};
  return {Quantity{std::string(text.substr(0, length)), *reading.unit}, ""};
}

std::optional<double> read_number(std::string_view text) {
  text = trim(text);
  if (text.empty() || number_length(text) != text.size()) return {};
  const double value = value_of_digits(text, 0);
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

UnitSystem::UnitSystem(const Unit& length, const Unit& force, const Unit& time, const Unit& angle)
    : length_(length.scale),
      mass_(force.scale + 2 * time.scale + (-1) * length.scale),
      time_(time.scale),
      angle_(angle.scale) {}

Scale UnitSystem::scale_of(const Dimension& dimension) const {
  return dimension.length * length_ + dimension.mass * mass_ + dimension.time * time_ +
         dimension.angle * angle_;
}

double UnitSystem::value_of(const Quantity& quantity) const {
  const Scale ratio = quantity.unit.scale + (-1) * scale_of(quantity.unit.dimension);
  double factor = 1.0;
  for (std::size_t i = 0; i < unit_constants.size(); ++i) {
    if (ratio.constants[i] != 0) factor *= std::pow(unit_constants[i], ratio.constants[i]);
  }
  return value_of_digits(quantity.number, ratio.decimal) * factor;
}

double UnitSystem::with_radians(double value, const Dimension& dimension) const {
  if (dimension.angle == 0) return value;
  return dimension.angle > 0 ? radians(value) : value / radians(1.0);
}

double UnitSystem::radians(double angle) const {
  double factor = 1.0;
  for (std::size_t i = 0; i < unit_constants.size(); ++i) {
    if (angle_.constants[i] != 0) factor *= std::pow(unit_constants[i], angle_.constants[i]);
  }
  return angle * factor * std::pow(10.0, angle_.decimal);
}

}  // namespace flexura

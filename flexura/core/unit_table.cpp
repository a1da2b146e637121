#include "flexura/core/unit_table.hpp"

namespace flexura {
namespace {

using namespace std::string_literals;
using enum UnitConstant;

constexpr Scale constant(UnitConstant c, int power = 1) {
  Scale scale;
  scale.constants[static_cast<std::size_t>(c)] = power;
  return scale;
}

struct NamedUnit {
  std::string_view word;
  Unit unit;
};

// These take the metric prefixes.
constexpr NamedUnit metric_units[] = {
    {"m", {dimensions::length, {}}},  {"g", {dimensions::mass, ten(-3)}},
    {"s", {dimensions::time, {}}},    {"N", {dimensions::force, {}}},
    {"Pa", {dimensions::stress, {}}}, {"J", {dimensions::moment, {}}},
    {"rad", {dimensions::angle, {}}}, {"Hz", {dimensions::frequency, {}}},
};

constexpr Scale inch_scale = constant(inch) + ten(-4);
constexpr Scale pound_scale = constant(pound) + ten(-8);
constexpr Scale gravity_scale = constant(gravity) + ten(-5);
constexpr Scale pound_force = pound_scale + gravity_scale;
constexpr Scale psi_scale = pound_force + (-2) * inch_scale;
constexpr Scale degree = constant(pi) + constant(eighteen, -1) + ten(-1);
constexpr Scale turn = constant(two) + constant(pi);

constexpr NamedUnit other_units[] = {
    {"in", {dimensions::length, inch_scale}},
    {"ft", {dimensions::length, constant(twelve) + inch_scale}},
    {"mil", {dimensions::length, inch_scale + ten(-3)}},
    {"thou", {dimensions::length, inch_scale + ten(-3)}},
    {"lb", {dimensions::mass, pound_scale}},
    {"lbm", {dimensions::mass, pound_scale}},
    {"oz", {dimensions::mass, pound_scale + constant(two, -4)}},
    {"slug", {dimensions::mass, pound_force + (-1) * (constant(twelve) + inch_scale)}},
    {"t", {dimensions::mass, ten(3)}},
    {"lbf", {dimensions::force, pound_force}},
    {"ozf", {dimensions::force, pound_force + constant(two, -4)}},
    {"kip", {dimensions::force, pound_force + ten(3)}},
    {"kgf", {dimensions::force, gravity_scale}},
    {"gf", {dimensions::force, gravity_scale + ten(-3)}},
    {"dyn", {dimensions::force, ten(-5)}},
    {"min", {dimensions::time, constant(sixty)}},
    {"h", {dimensions::time, constant(sixty, 2)}},
    {"deg", {dimensions::angle, degree}},
    {"°", {dimensions::angle, degree}},
    {"arcmin", {dimensions::angle, degree + constant(sixty, -1)}},
    {"arcsec", {dimensions::angle, degree + constant(sixty, -2)}},
    {"rev", {dimensions::angle, turn}},
    {"turn", {dimensions::angle, turn}},
    {"rpm", {dimensions::angular_speed, turn + constant(sixty, -1)}},
    {"psi", {dimensions::stress, psi_scale}},
    {"ksi", {dimensions::stress, psi_scale + ten(3)}},
    {"Mpsi", {dimensions::stress, psi_scale + ten(6)}},
    {"bar", {dimensions::stress, ten(5)}},
};

struct Prefix {
  std::string_view word;
  int decimal;
};
// Micro is u, the micro sign or the Greek letter.
constexpr Prefix prefixes[] = {{"n", -9}, {"u", -6}, {"\u00b5", -6}, {"\u03bc", -6}, {"m", -3},
                               {"c", -2}, {"d", -1}, {"k", 3},       {"M", 6},       {"G", 9}};

struct DimensionWords {
  Dimension dimension;
  std::string_view name;
  std::string_view example;
  std::string_view common;
};
constexpr DimensionWords dimension_words[] = {
    {dimensions::number, "a number", "0.5", ""},
    {dimensions::length, "a length", "\"0.1 mm\"", "mm, m, um, nm, cm, km, in, ft, mil"},
    {dimensions::area, "an area", "\"2.5 mm^2\"", "mm^2, m^2, in^2"},
    {dimensions::second_moment, "a second moment of area", "\"0.17 mm^4\"", "mm^4, m^4, in^4"},
    {dimensions::mass, "a mass", "\"20 g\"", "kg, g, t, lb, slug"},
    {dimensions::time, "a time", "\"0.5 s\"", "s, ms, us, min, h"},
    {dimensions::angle, "an angle", "\"30 deg\"", "rad, deg"},
    {dimensions::force, "a force", "\"10 mN\"", "N, mN, uN, kN, lbf, kgf"},
    {dimensions::moment, "a moment", "\"5 N mm\"", "N mm, N m, lbf in"},
    {dimensions::stress, "a stress", "\"2.1 GPa\"", "MPa, GPa, Pa, psi, ksi"},
    {dimensions::density, "a density", "\"913 kg/m^3\"", "kg/m^3, g/cm^3, lb/in^3"},
    {dimensions::inertia, "a moment of inertia", "\"3 kg mm^2\"", "kg m^2, lb in^2"},
    {dimensions::frequency, "a frequency", "\"50 Hz\"", "Hz"},
    {dimensions::angular_speed, "an angular speed", "\"300 rpm\"", "rpm, rad/s"},
    {dimensions::speed, "a speed", "\"2 m/s\"", "m/s"},
    {dimensions::acceleration, "an acceleration", "\"9.81 m/s^2\"", "m/s^2"},
    {dimensions::force_per_length, "a stiffness", "\"3 N/mm\"", "N/mm, N/m"},
    {dimensions::torsional_stiffness, "a torsional stiffness", "\"5 N mm/rad\"", "N mm/rad"},
    {dimensions::damping, "a damping", "\"0.2 N s/mm\"", "N s/mm, N s/m"},
    {dimensions::torsional_damping, "a torsional damping", "\"0.2 N mm s/rad\"", "N mm s/rad"},
};

const DimensionWords* words_of(const Dimension& dimension) {
  for (const DimensionWords& words : dimension_words) {
    if (words.dimension == dimension) return &words;
  }
  return nullptr;
}

}  // namespace

std::string describe(const Dimension& dimension) {
  if (const DimensionWords* words = words_of(dimension)) return std::string(words->name);
  std::string text = "a quantity of dimension";
  const auto add = [&text](const char* name, int power) {
    if (power != 0) text += " "s + name + (power == 1 ? "" : "^" + std::to_string(power));
  };
  add("mass", dimension.mass);
  add("length", dimension.length);
  add("time", dimension.time);
  add("angle", dimension.angle);
  return text;
}

std::string example_of(const Dimension& dimension) {
  const DimensionWords* words = words_of(dimension);
  return words ? std::string(words->example) : "";
}

std::string common_units(const Dimension& dimension) {
  const DimensionWords* words = words_of(dimension);
  return words ? std::string(words->common) : "";
}

const std::vector<std::string>& unit_words() {
  static const std::vector<std::string> words = [] {
    std::vector<std::string> list = {"mm", "m",   "um",  "nm",  "cm",  "km",   "N",  "mN",
                                     "uN", "kN",  "s",   "ms",  "us",  "kg",   "g",  "mg",
                                     "Pa", "kPa", "MPa", "GPa", "rad", "mrad", "Hz", "J"};
    for (const NamedUnit& named : other_units) list.emplace_back(named.word);
    return list;
  }();
  return words;
}

std::optional<Unit> find_unit_word(std::string_view word) {
  for (const NamedUnit& named : other_units) {
    if (named.word == word) return named.unit;
  }
  for (const NamedUnit& named : metric_units) {
    if (named.word == word) return named.unit;
  }
  for (const Prefix& prefix : prefixes) {
    if (!word.starts_with(prefix.word)) continue;
    for (const NamedUnit& named : metric_units) {
      if (word.substr(prefix.word.size()) == named.word) {
        return Unit{named.unit.dimension, named.unit.scale + ten(prefix.decimal)};
      }
    }
  }
  return {};
}

}  // namespace flexura

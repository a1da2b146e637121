#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace flexura {

/// Exponents of length, mass, time and plane angle. Angles count as a dimension of their own so
/// that "30 deg" cannot stand for a number; force is mass length / time^2.
struct Dimension {
  int length = 0;
  int mass = 0;
  int time = 0;
  int angle = 0;

  friend constexpr bool operator==(const Dimension&, const Dimension&) = default;
};

namespace dimensions {
inline constexpr Dimension number{};
inline constexpr Dimension length{1, 0, 0, 0};
inline constexpr Dimension area{2, 0, 0, 0};
inline constexpr Dimension second_moment{4, 0, 0, 0};
inline constexpr Dimension mass{0, 1, 0, 0};
inline constexpr Dimension time{0, 0, 1, 0};
inline constexpr Dimension angle{0, 0, 0, 1};
inline constexpr Dimension force{1, 1, -2, 0};
inline constexpr Dimension moment{2, 1, -2, 0};
inline constexpr Dimension force_per_length{0, 1, -2, 0};
inline constexpr Dimension torsional_stiffness{2, 1, -2, -1};
inline constexpr Dimension damping{0, 1, -1, 0};
inline constexpr Dimension torsional_damping{2, 1, -1, -1};
inline constexpr Dimension frequency{0, 0, -1, 0};
inline constexpr Dimension angular_speed{0, 0, -1, 1};
inline constexpr Dimension speed{1, 0, -1, 0};
inline constexpr Dimension acceleration{1, 0, -2, 0};
inline constexpr Dimension stress{-1, 1, -2, 0};
inline constexpr Dimension density{-3, 1, 0, 0};
inline constexpr Dimension inertia{2, 1, 0, 0};
}  // namespace dimensions

/// "a length", "a stress", ..; "a quantity of dimension length^3 time^-1" where it has no name.
std::string describe(const Dimension& dimension);

/// A quantity of this dimension as one would write it, quotes included: "\"2.1 GPa\"".
std::string example_of(const Dimension& dimension);

/// A unit's size in kg, m, s, rad as 10^decimal times powers of a few exact constants (2, 12, 18,
/// 60, 254, pound, standard gravity, pi), so that equal factors cancel without rounding.
struct Scale {
  int decimal = 0;
  std::array<int, 8> constants{};

  friend constexpr bool operator==(const Scale&, const Scale&) = default;
};

struct Unit {
  Dimension dimension;
  Scale scale;
};

/// Either a unit or why the text is none.
struct UnitReading {
  std::optional<Unit> unit;
  std::string error;
};

/// Reads a unit by this closed grammar:
///
///     unit   = ["/"] factor { (" " | "*" | "/") factor }  "/" divides by the next factor only
///     factor = word [ ["^"] ["-"] digit ]                 m^2, s2, s^-2, m² and m³ too
///     word   = [prefix] metric | other
///     prefix = n u µ m c d k M G
///     metric = m g s N Pa J rad Hz
///     other  = in ft mil thou (length), lb lbm oz slug t (mass), lbf ozf kip kgf gf dyn (force),
///              min h (time), deg ° arcmin arcsec rev turn (angle), rpm, psi ksi Mpsi bar (stress)
///
/// `lb` is a mass, `lbf` a force.
UnitReading read_unit(std::string_view text);

/// Words of the table that have this dimension and are good names for a declared unit, commonest
/// first ("mm, m, um, .."); empty if there is none.
std::string common_units(const Dimension& dimension);

/// A number with a unit as written.
struct Quantity {
  std::string number;  ///< its digits, kept so that decimal scaling rounds only once
  Unit unit;
};

struct QuantityReading {
  std::optional<Quantity> quantity;
  std::string error;
};

/// Reads "2.1 GPa", "0.1mm", "-240 deg", "913 kg/m^3", "1e3 N mm". Neither "nan" nor "inf" is a
/// number here, and a number without a unit is an error that says so.
QuantityReading read_quantity(std::string_view text);

/// The whole of `text` as a finite decimal number, whatever the locale; spaces around it are fine.
std::optional<double> read_number(std::string_view text);

/// The consistent system spanned by declared units of length, force and time; mass is force
/// time^2 / length.
class UnitSystem {
 public:
  /// SI: m, N, s, rad.
  UnitSystem() = default;
  /// Precondition: the units have the dimensions of length, force, time and angle.
  UnitSystem(const Unit& length, const Unit& force, const Unit& time, const Unit& angle);

  /// The quantity as a plain number in this system; infinite where a double cannot hold it. If
  /// only powers of ten lie between the units, the result is the double nearest to the decimal
  /// number: "50 um" in mm is the same double as 0.05.
  double value_of(const Quantity& quantity) const;

  /// A plain number in the declared angle unit, in radians.
  double radians(double angle) const;

  /// A plain number in declared units, with whatever angle its dimension has in radians.
  double with_radians(double value, const Dimension& dimension) const;

 private:
  Scale scale_of(const Dimension& dimension) const;

  Scale length_;
  Scale mass_;
  Scale time_;
  Scale angle_;
};

}  // namespace flexura

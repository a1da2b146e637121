#include "flexura/core/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace flexura {
namespace {

UnitSystem make_system(const char* length, const char* force, const char* time,
                       const char* angle = "rad") {
  return {*read_unit(length).unit, *read_unit(force).unit, *read_unit(time).unit,
          *read_unit(angle).unit};
}

double value(const UnitSystem& system, const char* text) {
  const QuantityReading reading = read_quantity(text);
  EXPECT_TRUE(reading.quantity.has_value()) << text << ": " << reading.error;
  return reading.quantity ? system.value_of(*reading.quantity) : std::nan("");
}

// Decimal factors must give the very double that the scaled number would be read as.
TEST(Units, DecimalFactorsRoundOnce) {
  const UnitSystem mm = make_system("mm", "N", "s");
  EXPECT_EQ(value(mm, "2.1 GPa"), 2100.0);
  EXPECT_EQ(value(mm, "50 um"), 0.05);
  EXPECT_EQ(value(mm, "50 \u00b5m"), 0.05);
  EXPECT_EQ(value(mm, "50\u03bcm"), 0.05);
  EXPECT_EQ(value(mm, "0.7 m"), 700.0);
  EXPECT_EQ(value(mm, "+1.5e-3 N m"), 1.5);
  EXPECT_EQ(value(mm, "913 kg/m^3"), 913e-12);
  EXPECT_EQ(value(mm, "27.4434e-6 m^2"), 27.4434);
  EXPECT_EQ(value(make_system("m", "N", "s"), "0.1 mm"), 1e-4);
  EXPECT_EQ(value(make_system("um", "mN", "ms"), "2.1 GPa"), 2.1);
}

// 1 lbf = 0.45359237 kg * 9.80665 m/s^2, 1 in = 0.0254 m, exactly (NIST SP 811, appendix B).
TEST(Units, ImperialFactors) {
  const UnitSystem si;
  EXPECT_DOUBLE_EQ(value(si, "1 lbf"), 4.4482216152605);
  EXPECT_DOUBLE_EQ(value(si, "1 psi"), 6894.757293168361);
  EXPECT_DOUBLE_EQ(value(si, "1 lb/in^3"), 27679.904710203125);
  EXPECT_DOUBLE_EQ(value(si, "1 ft"), 0.3048);
  EXPECT_DOUBLE_EQ(value(si, "1 slug"), 14.593902937206364);
  EXPECT_DOUBLE_EQ(value(si, "1 lbf s2/in"), 175.12683524647636);
}

TEST(Units, EqualFactorsCancelExactly) {
  const UnitSystem imperial = make_system("in", "lbf", "s");
  EXPECT_EQ(value(imperial, "10.3e6 psi"), 10.3e6);
  EXPECT_EQ(value(imperial, "3.88e-4 in^4"), 3.88e-4);
  EXPECT_DOUBLE_EQ(value(imperial, "0.098 lb/in^3"), 0.098 / 386.08858267716535);
  EXPECT_DOUBLE_EQ(value(imperial, "0.0976 lb"), 0.0976 / 386.08858267716535);
}

TEST(Units, Angles) {
  const UnitSystem rad = make_system("mm", "N", "s");
  EXPECT_DOUBLE_EQ(value(rad, "-240 deg"), -4.0 * std::numbers::pi / 3.0);
  EXPECT_DOUBLE_EQ(value(rad, "300 rpm"), 10.0 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(value(rad, "0.5 turn"), std::numbers::pi);
  const UnitSystem deg = make_system("mm", "N", "s", "deg");
  EXPECT_EQ(value(deg, "30 deg"), 30.0);
  EXPECT_DOUBLE_EQ(deg.radians(30.0), std::numbers::pi / 6.0);
  EXPECT_EQ(rad.radians(1.5), 1.5);
}

TEST(Units, WaysToWriteAProduct) {
  const UnitSystem mm = make_system("mm", "N", "s");
  for (const char* text :
       {"3 N mm", "3 N*mm", "3 N * mm", "3N mm", "3e3 N um", "3 N/mm^-1", "3e-3 N m", "3e-3 J",
        "3e-3 kg m^2 s^-2", "3e-3 kg*m2/s2", "3e-3 kg m\u00b2/s\u00b2", "3e-3 kg m m/s/s"}) {
    EXPECT_EQ(value(mm, text), 3.0) << text;
    EXPECT_EQ(read_quantity(text).quantity->unit.dimension, dimensions::moment) << text;
  }
}

TEST(Units, AUnitMayBeginWithWhatItDividesBy) {
  EXPECT_EQ(value(UnitSystem(), "0.1 /s"), 0.1);
  EXPECT_EQ(value(UnitSystem(), "3/ms"), 3000.0);
  EXPECT_EQ(read_unit("/s").unit->dimension, dimensions::frequency);
  EXPECT_EQ(read_unit("/").error, "the unit '/' is not complete");
}

// Degrees are for files; models count angles, and whatever is per angle or per time, in radians.
TEST(Units, RadiansWhereverAnAngleStands) {
  const UnitSystem deg = make_system("mm", "N", "s", "deg");
  const auto radians = [&](const char* text, const Dimension& dimension) {
    return deg.with_radians(value(deg, text), dimension);
  };
  EXPECT_DOUBLE_EQ(radians("300 rpm", dimensions::angular_speed), 10.0 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(radians("5 N mm/rad", dimensions::torsional_stiffness), 5.0);
  EXPECT_DOUBLE_EQ(radians("90 deg", dimensions::angle), std::numbers::pi / 2.0);
  EXPECT_EQ(radians("2 mm", dimensions::length), 2.0);
}

TEST(Units, PoundIsAMassPoundForceAForce) {
  EXPECT_EQ(read_unit("lb").unit->dimension, dimensions::mass);
  EXPECT_EQ(read_unit("lbf").unit->dimension, dimensions::force);
}

TEST(Units, WhatIsNoQuantity) {
  for (const char* text :
       {"",        " ",      "mm",     "nan mm",  "inf N", "- mm",  "1..2 mm", "1 2 mm",
        "0x10 mm", "1,5 mm", "1 mm^0", "1 mm^12", "1 mm^", "1 mm*", "1 //mm",  "1 mm//s",
        "1 (mm)",  "1 mm)",  "1 qm",   "1 mmm",   "1",     "1e5"}) {
    const QuantityReading reading = read_quantity(text);
    EXPECT_FALSE(reading.quantity.has_value()) << text;
    EXPECT_FALSE(reading.error.empty()) << text;
  }
}

TEST(Units, BeyondADouble) {
  const UnitSystem si;
  EXPECT_TRUE(std::isinf(value(si, "1e999 m")));
  EXPECT_TRUE(std::isinf(value(si, "1e99999999999999999999 m")));
  EXPECT_FALSE(read_number("1e999").has_value());
}

TEST(Units, PlainNumbers) {
  EXPECT_EQ(read_number(" -2.5e-3 "), -2.5e-3);
  EXPECT_EQ(read_number("+7"), 7.0);
  EXPECT_FALSE(read_number("2,5").has_value());
  EXPECT_FALSE(read_number("nan").has_value());
  EXPECT_FALSE(read_number("2 mm").has_value());
}

TEST(Units, DimensionsHaveNames) {
  EXPECT_EQ(describe(dimensions::stress), "a stress");
  EXPECT_EQ(describe(dimensions::damping), "a damping");
  EXPECT_EQ(describe({3, 0, -1, 0}), "a quantity of dimension length^3 time^-1");
}

}  // namespace
}  // namespace flexura

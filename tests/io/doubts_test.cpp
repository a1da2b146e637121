// Warnings: what a file may say, but hardly means.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/io/model_text.hpp"

namespace flexura {
namespace {

using testing::ModelText;

ModelReading with_modulus(const std::string& modulus, const std::string& units) {
  ModelText model;
  if (!units.empty()) model.units = units;
  model.materials = "[materials.steel]\nyoungs_modulus = " + modulus + "\npoissons_ratio = 0.3\n";
  return read_model_text(model.text());
}

void expect_doubt(const ModelReading& reading, const std::string& message) {
  EXPECT_TRUE(reading.model.has_value());
  ASSERT_EQ(reading.diagnostics.size(), 1u) << testing::messages(reading.diagnostics);
  EXPECT_EQ(reading.diagnostics[0].severity, Severity::warning);
  EXPECT_EQ(reading.diagnostics[0].message, "materials.steel.youngs_modulus: " + message);
  EXPECT_EQ(reading.diagnostics[0].position, (SourcePosition{7, 18}));
}

TEST(Doubts, PascalsInAFileOfNewtonsAndMillimetres) {
  expect_doubt(with_modulus("210e9", ""),
               "2.1e+17 Pa in SI units, stiffer than any material; a number without a unit counts "
               "in N/mm^2, where 210 GPa is 210000: write \"210 GPa\" if that is meant");
}

TEST(Doubts, NumbersOfNewtonsAndMillimetresInAFileOfMetres) {
  expect_doubt(with_modulus("2100", "[units]\nlength = \"m\"\nforce = \"N\"\ntime = \"s\"\n"),
               "2100 Pa in SI units, softer than any material; a number without a unit counts in "
               "N/m^2, where 210 GPa is 2.1e+11: write \"210 GPa\" or the like, with its unit");
}

/// The range is judged in SI units, whatever the file counts in, its ends included.
TEST(Doubts, MaterialsFromGelsToDiamondHaveNone) {
  const std::string inches = "[units]\nlength = \"in\"\nforce = \"lbf\"\ntime = \"s\"\n";
  for (const char* modulus : {"\"10 kPa\"", "\"2100 MPa\"", "\"1220 GPa\""})
    for (const std::string& units : {std::string(), inches})
      EXPECT_EQ(testing::messages(with_modulus(modulus, units).diagnostics), "") << modulus;
  EXPECT_EQ(with_modulus("\"9 kPa\"", inches).diagnostics.size(), 1u);
  EXPECT_EQ(with_modulus("\"2100 GPa\"", inches).diagnostics.size(), 1u);
}

/// A warning stands among the errors of a file that has some, and makes none by itself.
TEST(Doubts, StandBesideErrors) {
  ModelText model;
  model.materials = "[materials.steel]\nyoungs_modulus = 210e9\npoissons_ratio = 0.7\n";
  const ModelReading reading = read_model_text(model.text());
  EXPECT_FALSE(reading.model.has_value());
  ASSERT_EQ(reading.diagnostics.size(), 2u) << testing::messages(reading.diagnostics);
  EXPECT_EQ(reading.diagnostics[0].severity, Severity::warning);
  EXPECT_EQ(reading.diagnostics[1].severity, Severity::error);
}

/// Where the units are mistaken themselves, nothing is known about moduli.
TEST(Doubts, NeedUnits) {
  const ModelReading reading =
      with_modulus("210e9", "[units]\nlength = \"mn\"\nforce = \"N\"\ntime = \"s\"\n");
  for (const Diagnostic& d : reading.diagnostics) EXPECT_EQ(d.severity, Severity::error);
}

TEST(Doubts, LeaveTheExitStatusAlone) {
  const auto file = std::filesystem::temp_directory_path() / "flexura_doubts_test.toml";
  ModelText model;
  model.materials = "[materials.steel]\nyoungs_modulus = 210e9\npoissons_ratio = 0.3\n";
  std::ofstream(file) << model.text();
  const std::string command = "'" FLEXURA_EXECUTABLE "' check '" + file.string() + "' 2>&1";
  EXPECT_EQ(std::system((command + " | grep -q ' warning: '").c_str()), 0);
  EXPECT_EQ(std::system((command + " >/dev/null").c_str()), 0);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace flexura

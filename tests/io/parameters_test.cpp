#include <gtest/gtest.h>

#include <clocale>
#include <numbers>

#include "flexura/io/model_reader.hpp"
#include "tests/io/model_text.hpp"

namespace flexura {
namespace {

using testing::messages;
using testing::ModelText;
using testing::read_valid;

ModelText with_thickness(const std::string& parameters, const std::string& thickness) {
  ModelText text;
  text.parameters = "[parameters]\n" + parameters;
  text.sections = "[sections.strip]\nrectangle = { thickness = " + thickness + ", width = 1.0 }\n";
  return text;
}

double thickness(const ModelText& text, const ParameterOverrides& overrides = {}) {
  const Model model = read_valid(text.text(), overrides);
  if (model.sections.empty()) return -1.0;
  return std::get<RectangleSection>(model.sections[0].shape).thickness;
}

std::string complaints(const ModelText& text, const ParameterOverrides& overrides = {}) {
  return messages(read_model_text(text.text(), overrides).diagnostics);
}

TEST(Parameters, NumbersQuantitiesAndExpressionsInAnyOrder) {
  const ModelText text =
      with_thickness("c = \"= a + b\"\na = \"50 um\"\nb = \"= 2*a\"\nn = 3\n", "\"= n*c + 0.1\"");
  EXPECT_DOUBLE_EQ(thickness(text), 3.0 * 0.15 + 0.1);
}

TEST(Parameters, TheNumberIsTheSameDoubleAsWhenWrittenOut) {
  EXPECT_EQ(thickness(with_thickness("t = 0.1\n", "\"= t\"")), 0.1);
}

TEST(Parameters, FunctionsAndPi) {
  EXPECT_DOUBLE_EQ(thickness(with_thickness("a = 4\n", "\"=sqrt(a) + sin(pi/2) + max(1, a)\"")),
                   7.0);
  EXPECT_DOUBLE_EQ(thickness(with_thickness("a = 4\n", "\" = a > 3 ? 2^3 : 0.1\"")), 8.0);
}

TEST(Parameters, AngleParametersAreInTheDeclaredAngleUnit) {
  ModelText text;
  text.units += "angle = \"deg\"\n";
  text.parameters = "[parameters]\nphi = \"0.5 turn\"\n";
  text.axis = "{ arc = { centre = [0, 0], radius = 2, start = 0, sweep = \"= phi/2\" } }";
  const Model model = read_valid(text.text());
  EXPECT_DOUBLE_EQ(std::get<ArcAxis>(model.flexures[0].axis).sweep, std::numbers::pi / 2.0);
}

TEST(Parameters, TheLocaleDoesNotMatter) {
  const char* german = std::setlocale(LC_ALL, "de_DE.UTF-8");
  EXPECT_EQ(thickness(with_thickness("t = \"100.5 um\"\n", "\"= t + 0.5\"")), 0.6005);
  if (german) std::setlocale(LC_ALL, "C");
}

TEST(Overrides, NumberQuantityOrExpression) {
  const ModelText text = with_thickness("t = 0.1\nw = \"= 2*t\"\n", "\"= w\"");
  EXPECT_DOUBLE_EQ(thickness(text), 0.2);
  EXPECT_DOUBLE_EQ(thickness(text, {{"t", "0.3"}}), 0.6);
  EXPECT_DOUBLE_EQ(thickness(text, {{"t", "50 um"}}), 0.1);
  EXPECT_DOUBLE_EQ(thickness(text, {{"w", "= t/2"}}), 0.05);
  EXPECT_DOUBLE_EQ(thickness(text, {{"t", "1"}, {"w", "=t+1"}}), 2.0);
}

TEST(Overrides, ReplaceWhateverTheFileSaid) {
  EXPECT_DOUBLE_EQ(thickness(with_thickness("t = \"thin\"\n", "\"= t\""), {{"t", "0.3"}}), 0.3);
}

TEST(Overrides, MistakesStandAtTheBeginningOfTheFile) {
  const ModelText text = with_thickness("thick = 0.1\n", "\"= thick\"");
  EXPECT_EQ(complaints(text, {{"thik", "0.3"}}),
            "1:1: --set thik=0.3: unknown parameter 'thik'; did you mean 'thick'?\n");
  EXPECT_EQ(complaints(text, {{"thick", "nan"}}),
            "1:1: parameters.thick: expected a number, a quantity with a unit or an expression "
            "\"= ..\", got --set thick=nan: it does not begin with a number\n");
  EXPECT_EQ(complaints(text, {{"thick", "= 2*thick"}}),
            "1:1: parameters.thick: the parameter is defined by itself: thick -> thick\n");
  EXPECT_EQ(
      complaints(text, {{"thick", "-1"}}),
      "12:27: sections.strip.rectangle.thickness: must be greater than 0, is -1; check the sign\n");
  EXPECT_EQ(complaints(ModelText(), {{"t", "1"}}),
            "1:1: --set t=1: unknown parameter 't'; the model has no parameters\n");
}

TEST(Parameters, AMistakeIsReportedOnceHoweverOftenItIsUsed) {
  EXPECT_EQ(complaints(with_thickness("a = \"= 1/0\"\nb = \"= a\"\nc = \"= a + b\"\n", "\"= c\"")),
            "7:5: parameters.a: cannot evaluate \"= 1/0\": its value is infinite\n");
}

TEST(Parameters, EveryCycleIsReportedOnce) {
  EXPECT_EQ(complaints(with_thickness("d = \"= a\"\na = \"= b + x\"\nb = \"= a\"\n"
                                      "x = \"= y\"\ny = \"= x\"\n",
                                      "\"= d + y\"")),
            "8:5: parameters.a: the parameter is defined by itself: a -> b -> a\n"
            "10:5: parameters.x: the parameter is defined by itself: x -> y -> x\n");
}

TEST(Parameters, LongChainsAreFine) {
  std::string chain = "p0 = 0.1\n";
  for (int i = 1; i <= 2000; ++i) {
    chain += "p" + std::to_string(i) + " = \"= p" + std::to_string(i - 1) + "\"\n";
  }
  EXPECT_EQ(thickness(with_thickness(chain, "\"= p2000\"")), 0.1);
}

}  // namespace
}  // namespace flexura

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <thread>

#include "flexura/io/expression.hpp"
#include "tests/io/model_text.hpp"

namespace flexura {
namespace {

namespace fs = std::filesystem;
using testing::ModelText;
using testing::read_valid;

constexpr double pi = std::numbers::pi;

ModelText with_history(const std::string& history, const std::string& parameters = "") {
  ModelText text;
  text.units = "[units]\nlength = \"mm\"\nforce = \"N\"\ntime = \"ms\"\nangle = \"deg\"\n";
  text.parameters = parameters;
  text.materials =
      "[materials.steel]\nyoungs_modulus = \"210 GPa\"\npoissons_ratio = 0.3\n"
      "density = \"7850 kg/m^3\"\n";
  text.studies =
      "[studies.shake]\nkind = \"transient\"\nduration = 2\nmodelings = [\"exact\"]\n"
      "loads = [{ on = \"stage\", moment = 1, history = " +
      history + " }]\n";
  return text;
}

TimeHistory history_of(const Model& model) {
  if (model.studies.empty()) return LinearHistory{};
  return std::get<TransientStudy>(model.studies[0].kind).loads.at(0).history;
}

TimeHistory read(const std::string& history, const std::string& parameters = "") {
  return history_of(read_valid(with_history(history, parameters).text()));
}

TEST(Histories, EveryKindHasItsTable) {
  EXPECT_EQ(std::get<StepHistory>(read("{ step = \"0.5 s\" }")).at, 500.0);
  const auto ramp = std::get<RampHistory>(read("{ ramp = [0, \"1 s\"] }"));
  EXPECT_EQ(ramp.start, 0.0);
  EXPECT_EQ(ramp.end, 1000.0);
  EXPECT_FALSE(ramp.smooth);
  EXPECT_TRUE(std::get<RampHistory>(read("{ ramp = [0, 1], smooth = true }")).smooth);
  const auto pulse =
      std::get<HalfSineHistory>(read("{ half_sine = { start = 1, duration = 0.5 } }"));
  EXPECT_EQ(pulse.start, 1.0);
  EXPECT_EQ(pulse.duration, 0.5);
  EXPECT_EQ(std::get<HalfSineHistory>(read("{ half_sine = { duration = 1 } }")).start, 0.0);
}

TEST(Histories, FrequenciesAreCyclesPerTime) {
  const auto shaking =
      std::get<HarmonicHistory>(read("{ harmonic = { frequency = \"50 Hz\", phase = 90 } }"));
  EXPECT_DOUBLE_EQ(shaking.angular_frequency, 2.0 * pi * 0.05);  // per ms
  EXPECT_DOUBLE_EQ(shaking.phase, pi / 2.0);
  EXPECT_EQ(std::get<HarmonicHistory>(read("{ harmonic = { frequency = 1 } }")).phase, 0.0);
}

TEST(Histories, TablesHaveRows) {
  const auto table = std::get<TableHistory>(
      read("{ table = [[0, 0], [\"1 ms\", \"= 2*a\"], [5, -1]], smooth = true }",
           "[parameters]\na = 3\n"));
  EXPECT_EQ(table.times(), (std::vector<double>{0.0, 1.0, 5.0}));
  EXPECT_EQ(table.values(), (std::vector<double>{0.0, 6.0, -1.0}));
  EXPECT_TRUE(table.smooth());
}

TEST(Histories, ExpressionsOfTime) {
  const std::string parameters = "[parameters]\nw = 3\nt = 100\n";
  const TimeHistory history = read("\"= sin(w*t)\"", parameters);
  EXPECT_DOUBLE_EQ(evaluate_history(history, 0.4).value, std::sin(1.2));  // t is the time
  EXPECT_NEAR(evaluate_history(history, 0.4).rate, 3.0 * std::cos(1.2), 1e-8);
}

/// A history beside the model that is read from its file; both files go.
class HistoryFile : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  ModelReading read_with(const std::string& csv,
                         const std::string& keys = "time = \"t\", value = \"a\"") {
    std::ofstream(folder_ / "ground.csv", std::ios::binary) << csv;
    const fs::path model = folder_ / "model.toml";
    std::ofstream(model) << with_history("{ file = \"ground.csv\", " + keys + " }").text();
    return read_model(model);
  }

  void expect_complaint(const std::string& csv, const std::string& message) {
    const ModelReading reading = read_with(csv);
    ASSERT_EQ(reading.diagnostics.size(), 1u) << testing::messages(reading.diagnostics);
    EXPECT_NE(reading.diagnostics[0].message.find(message), std::string::npos)
        << reading.diagnostics[0].message;
  }

  // Tests may run side by side.
  fs::path folder_ = fs::path(::testing::TempDir()) /
                     ::testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(HistoryFile, ColumnsAreFoundByTheirNames) {
  const ModelReading reading =
      read_with("\xEF\xBB\xBF\"x\", t ,a\r\n9, 0,1.5\r\n\r\n9,1e0, -2\r\n9,2,\"3\"\r\n",
                "time = \"t\", value = \"a\", smooth = true");
  EXPECT_EQ(testing::messages(reading.diagnostics), "");
  ASSERT_TRUE(reading.model.has_value());
  const auto table = std::get<TableHistory>(history_of(*reading.model));
  EXPECT_EQ(table.times(), (std::vector<double>{0.0, 1.0, 2.0}));
  EXPECT_EQ(table.values(), (std::vector<double>{1.5, -2.0, 3.0}));
  EXPECT_TRUE(table.smooth());
}

TEST_F(HistoryFile, SaysWhereItIsWrong) {
  expect_complaint("t,a\n0,1\n1,x\n2,1\n",
                   "file: ground.csv:3:3: 'x' in column 'a' is not a number");
  expect_complaint("t,a\n0,1\n1\n", "ground.csv:3:1: the line ends before column 'a'");
  expect_complaint("a,  t\n1,  0\n1,  2\n1,  2\n",
                   "ground.csv:4:5: times must ascend: 2 does not come after 2");
  expect_complaint("t,acc\n0,1\n", "value: 'ground.csv' has no column 'a'");
  expect_complaint("time,a\n0,1\n", "time: 'ground.csv' has no column 't'; valid: time, a");
  expect_complaint("t,a\n0,1\n", "'ground.csv' has one line of numbers; a history needs two");
  expect_complaint("t,a\n", "'ground.csv' has no line of numbers");
  expect_complaint("\n\n", "'ground.csv' is empty");
  expect_complaint("t,\xC3\xA4,a\n0,\xC3\xA4,\x1B[1m\n",
                   "ground.csv:2:5: '?[1m' in column 'a' is not a number");
  expect_complaint("t,a\n0,nan\n", "ground.csv:2:3: 'nan' in column 'a' is not a number");
}

TEST_F(HistoryFile, HasToBeThereAndNotTooLong) {
  std::ofstream(folder_ / "model.toml")
      << with_history("{ file = \"grund.csv\", time = \"t\", value = \"a\" }").text();
  const ModelReading missing = read_model(folder_ / "model.toml");
  ASSERT_EQ(missing.diagnostics.size(), 1u);
  EXPECT_NE(missing.diagnostics[0].message.find("cannot read 'grund.csv': No such file"),
            std::string::npos)
      << missing.diagnostics[0].message;
  ModelText device = with_history("{ file = \"/dev/zero\", time = \"t\", value = \"a\" }");
  const ModelReading endless = read_model_text(device.text());
  ASSERT_EQ(endless.diagnostics.size(), 1u);
  EXPECT_NE(endless.diagnostics[0].message.find("longer than 64 MB"), std::string::npos);
  ModelText directory = with_history("{ file = \"/\", time = \"t\", value = \"a\" }");
  const ModelReading refused = read_model_text(directory.text());
  ASSERT_EQ(refused.diagnostics.size(), 1u);
  EXPECT_NE(refused.diagnostics[0].message.find("it is a directory"), std::string::npos);
}

TEST(FunctionsOfTime, HideAParameterOfTheirVariablesName) {
  Formulas formulas;
  formulas.define("a", 2.0);
  formulas.define("t", 100.0);
  const Formulas::Function function = formulas.function_of("t", "a*t + pi");
  ASSERT_TRUE(function.function);
  EXPECT_DOUBLE_EQ(function.function(3.0), 6.0 + pi);
  EXPECT_EQ(formulas.evaluate("t").value, 100.0);
  EXPECT_TRUE(std::isnan(formulas.function_of("t", "sqrt(t)").function(-1.0)));
  EXPECT_EQ(formulas.function_of("t", "t, 2").error, "it gives 2 values");
  EXPECT_NE(formulas.function_of("t", "2*(t").error, "");
}

TEST(FunctionsOfTime, ServeThreadsByCopiesAndByTurns) {
  const Formulas::Function original = Formulas().function_of("t", "t^2 + 3*t");
  std::atomic<int> wrong = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&wrong, &original, i, copy = original.function] {
      const auto& function = i % 2 == 0 ? copy : original.function;
      for (int k = 0; k < 20000; ++k) {
        const double t = i + 1e-3 * k;
        if (std::abs(function(t) - t * (t + 3.0)) > 1e-9 * (1.0 + t * t)) ++wrong;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace flexura

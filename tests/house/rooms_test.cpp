// The rules of the house (CONTRIBUTING.md), held against every source, and first against made-up
// ones: a check that cannot fail is none.
#include <gtest/gtest.h>

#include <numeric>

#include "tests/house/rules.hpp"

namespace flexura::house {
namespace {

std::string joined(const Offences& offences) {
  return std::accumulate(offences.begin(), offences.end(), std::string(),
                         [](std::string all, const std::string& one) { return all + one + "\n"; });
}

TEST(Rooms, LowerRanksAndTheOwnRoomMayBeIncluded) {
  EXPECT_EQ(joined(room_offences("flexura/model/model.cpp",
                                 "#include \"flexura/model/model.hpp\"\n"
                                 "#include <vector>\n"
                                 "#include \"flexura/core/vec2.hpp\"\n"
                                 "// #include \"flexura/studies/study.hpp\"\n")),
            "");
}

TEST(Rooms, AHigherRankMayNotBeIncluded) {
  EXPECT_EQ(joined(room_offences("flexura/solvers/newton.hpp",
                                 "#pragma once\n"
                                 "#include \"flexura/model/model.hpp\"\n"
                                 "#  include <flexura/studies/path.hpp>\n")),
            "flexura/solvers/newton.hpp:2: rank 1 includes flexura/model/model.hpp of rank 2\n"
            "flexura/solvers/newton.hpp:3: rank 1 includes flexura/studies/path.hpp of rank 4\n");
}

TEST(Rooms, ASidewaysRoomMayNotBeIncluded) {
  EXPECT_EQ(joined(room_offences("flexura/geometry/arc.cpp",
                                 "#include \"flexura/energy/reissner.hpp\"\n")),
            "flexura/geometry/arc.cpp:1: rank 1 includes flexura/energy/reissner.hpp of rank 1\n");
}

TEST(Rooms, IncludesThatHideTheirRoomAreOffences) {
  EXPECT_EQ(joined(room_offences("flexura/core/a.cpp", "#include \"../studies/path.hpp\"\n")),
            "flexura/core/a.cpp:1: includes ../studies/path.hpp, which stands in no room\n");
  EXPECT_EQ(joined(room_offences("flexura/modelling/a.cpp", "")),
            "flexura/modelling/a.cpp:1: stands in no room\n");
}

TEST(Rooms, OneModelingMayNotIncludeAnother) {
  const char* text =
      "#include \"flexura/modelings/beam_element.hpp\"\n"
      "#include \"flexura/modelings/exact/modes.hpp\"\n"
      "#include \"flexura/modelings/system.hpp\"\n";
  EXPECT_EQ(joined(room_offences("flexura/modelings/exact.cpp", text)),
            "flexura/modelings/exact.cpp:1: modeling exact includes "
            "flexura/modelings/beam_element.hpp of another modeling\n");
  EXPECT_EQ(joined(room_offences("flexura/modelings/make_system.cpp", text)), "");
}

TEST(Hygiene, OffencesAreFound) {
  const std::string wide(101, 'x');
  std::string long_text;
  for (int i = 0; i < 401; ++i) long_text += "\n";
  EXPECT_EQ(joined(hygiene_offences("flexura/core/a.hpp", "// #pragma once\n" + wide + "\n")),
            "flexura/core/a.hpp:1: a header without #pragma once\n"
            "flexura/core/a.hpp:2: 101 columns, 100 is the most\n");
  EXPECT_EQ(joined(hygiene_offences("tests/a.cpp", long_text)),
            "tests/a.cpp:401: 401 lines, 400 is the most\n");
  std::string greek;
  for (int i = 0; i < 100; ++i) greek += "\u03c6";  // two bytes, one column
  EXPECT_EQ(joined(hygiene_offences("tests/a.cpp", greek + "\n")), "");
}

TEST(House, EverySourceKeepsToItsRoom) {
  const std::vector<std::string> files = sources_in({"flexura", "apps"});
  EXPECT_GT(files.size(), 10U);
  for (const std::string& file : files) EXPECT_EQ(joined(room_offences(file, read_text(file))), "");
}

TEST(House, EverySourceIsTidy) {
  for (const std::string& file :
       sources_in({"flexura", "apps", "tests", "verification", "benchmarks", "robustness", "fuzz"}))
    EXPECT_EQ(joined(hygiene_offences(file, read_text(file))), "");
}

}  // namespace
}  // namespace flexura::house

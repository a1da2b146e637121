#include "flexura/pictures/svg.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace flexura::pictures {
namespace {

TEST(PathData, IsRelativeAndShort) {
  PathData data;
  data.move({10.04, 20}).line({10.5, 19.96}).line({8, 25.25}).close();
  EXPECT_EQ(data.text(), "M10 20l.5 0l-2.5 5.3z");
}

TEST(PathData, CurvesCountFromTheirStart) {
  PathData data;
  data.move({1, 1}).curve({2, 3}, {3, 1}).line({4, 0});
  EXPECT_EQ(data.text(), "M1 1q1 2 2 0l1-1");
}

TEST(PathData, DoesNotDriftByRounding) {
  PathData data;
  data.move({0, 0});
  for (int k = 1; k <= 100; ++k) data.line({0.04 * k, 0});
  double x = 0;
  const std::string& text = data.text();
  for (std::size_t at = text.find('l'); at != std::string::npos; at = text.find('l', at + 1))
    x += std::stod(text.substr(at + 1));
  EXPECT_NEAR(x, 4.0, 1e-9);
}

TEST(PathData, TellsTheBoxWhatItDraws) {
  Box box;
  EXPECT_TRUE(box.empty());
  PathData(&box, 2).move({1, 1}).line({5, 3});
  EXPECT_EQ(box.low, (Vec2{-1, -1}));
  EXPECT_EQ(box.high, (Vec2{7, 5}));
}

TEST(PathData, PutsWhatIsNoNumberAtTheOrigin) {
  PathData data;
  data.move({std::nan(""), 1});
  EXPECT_EQ(data.text(), "M0 1");
}

TEST(PathElement, IsAnimatedWhereValuesChange) {
  Clock clock;
  clock.order = {0, 1, 0};
  clock.seconds = 2;
  clock.still = 1;
  EXPECT_EQ(path_element("class=\"a\"", {"M0 0", "M1 0"}, {"#000", "#000"}, clock),
            "<path class=\"a\" color=\"#000\" d=\"M1 0\"><animate attributeName=\"d\" dur=\"2s\" "
            "repeatCount=\"indefinite\" values=\"M0 0;M1 0;M0 0\"/></path>\n");
  clock.order.clear();
  EXPECT_EQ(path_element("class=\"a\"", {"M0 0", "M1 0"}, {}, clock),
            "<path class=\"a\" d=\"M1 0\"/>\n");
}

TEST(EscapeXml, LeavesOnlyCharactersOfXml) {
  EXPECT_EQ(escape_xml("a<b>&\"c\""), "a&lt;b&gt;&amp;&quot;c&quot;");
  EXPECT_EQ(escape_xml("\xC2\xB5m\x01\xFF\xC2"), "\xC2\xB5m");
}

}  // namespace
}  // namespace flexura::pictures

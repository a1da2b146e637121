// Grids for ParaView: read back as VTK's readers do.
#include "flexura/io/write_vtu.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <regex>
#include <span>

#include "flexura/io/base64.hpp"

namespace flexura {
namespace {

std::vector<unsigned char> decode(std::string_view text) {
  static const std::string digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const std::size_t digit = digits.find(c);
    if (digit == std::string::npos) break;
    bits = bits << 6U | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<unsigned char>(bits >> count & 255U));
  }
  return bytes;
}

std::string encode(std::string_view text) {
  std::string out;
  append_base64(std::as_bytes(std::span(text)).size() == 0
                    ? std::span<const unsigned char>()
                    : std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()),
                out);
  return out;
}

TEST(Base64, IsThatOfTheStandard) {
  const std::pair<const char*, const char*> known[] = {{"", ""},
                                                       {"f", "Zg=="},
                                                       {"fo", "Zm8="},
                                                       {"foo", "Zm9v"},
                                                       {"foob", "Zm9vYg=="},
                                                       {"fooba", "Zm9vYmE="},
                                                       {"foobar", "Zm9vYmFy"}};
  for (const auto& [text, coded] : known) EXPECT_EQ(encode(text), coded);
}

std::size_t number_in(const std::string& text, const std::string& attribute) {
  std::smatch match;
  EXPECT_TRUE(std::regex_search(text, match, std::regex(attribute + "=\"(\\d+)\"")));
  return std::stoul(match[1]);
}

template <class Number>
std::vector<Number> array_in(const std::string& text, const std::string& name) {
  std::smatch match;
  const std::regex element("<DataArray [^>]*Name=\"" + name + "\"[^>]*offset=\"(\\d+)\"/>");
  EXPECT_TRUE(std::regex_search(text, match, element)) << name;
  const std::size_t start = text.find('_', text.find("<AppendedData")) + 1;
  const auto bytes = decode(std::string_view(text).substr(start + std::stoul(match[1])));
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data(), sizeof size);
  EXPECT_LE(sizeof size + size, bytes.size());
  std::vector<Number> values(size / sizeof(Number));
  std::memcpy(values.data(), bytes.data() + sizeof size, size);
  return values;
}

/// Two strips: one of two elements of order 2 in the line, one quadrilateral.
FieldState two_strips() {
  StressField strip;
  strip.columns = 5;
  strip.rows = 3;
  strip.order_along = strip.order_across = 2;
  for (std::size_t c = 0; c < 5; ++c) {
    for (std::size_t r = 0; r < 3; ++r) {
      const Vec2 place{static_cast<double>(c), 0.1 * static_cast<double>(r)};
      strip.drawn.push_back(place);
      strip.places.push_back(place + Vec2{0.0, 0.5 * place.x});
      strip.stresses.push_back({1.0 / 3.0 + place.x, -place.y, 0.25, 0.0});
    }
  }
  strip.error_energies = {0.04, 0.01};
  strip.energy = 3.0;
  StressField quad;
  quad.columns = quad.rows = 2;
  quad.drawn = quad.places = {{9.0, 0.0}, {9.0, 1.0}, {10.0, 0.0}, {10.0, 1.0}};
  quad.stresses.resize(4);
  quad.error_energies = {0.0};
  quad.energy = 1.0;
  return {7, {{2, strip}, {4, quad}}};
}

TEST(WriteVtu, CountsAndNumbersAgree) {
  const FieldState fields = two_strips();
  const std::string text = make_vtu(fields, 0.35);
  const std::size_t points = number_in(text, "NumberOfPoints");
  const std::size_t cells = number_in(text, "NumberOfCells");
  EXPECT_EQ(points, 19U);
  EXPECT_EQ(cells, 9U);
  EXPECT_NE(text.find(">0.35</DataArray>"), std::string::npos);
  const auto places = array_in<double>(text, "points");
  const auto displacements = array_in<double>(text, "displacement");
  const auto stresses = array_in<double>(text, "stress");
  const auto principal = array_in<double>(text, "principal");
  const auto von_mises = array_in<double>(text, "von_mises");
  ASSERT_EQ(places.size(), 3 * points);
  ASSERT_EQ(displacements.size(), 3 * points);
  ASSERT_EQ(stresses.size(), 3 * points);
  ASSERT_EQ(principal.size(), 3 * points);
  ASSERT_EQ(von_mises.size(), points);
  const StressField& strip = fields.flexures[0].field;
  for (std::size_t k = 0; k < strip.stresses.size(); ++k) {
    const PlaneStress& s = strip.stresses[k];
    EXPECT_EQ(places[3 * k], strip.drawn[k].x);
    EXPECT_EQ(displacements[3 * k + 1], strip.places[k].y - strip.drawn[k].y);
    EXPECT_EQ(stresses[3 * k], s.xx);
    EXPECT_EQ(stresses[3 * k + 1], s.yy);
    EXPECT_EQ(stresses[3 * k + 2], s.xy);
    EXPECT_EQ(von_mises[k], von_mises_stress(s));
    EXPECT_NEAR(principal[3 * k] + principal[3 * k + 1], s.xx + s.yy, 1e-15);
  }
  EXPECT_EQ(places[3 * 15], 9.0);
}

TEST(WriteVtu, QuadrilateralsGoRoundCounterClockwise) {
  const std::string text = make_vtu(two_strips(), 1.0);
  const auto corners = array_in<std::int32_t>(text, "connectivity");
  const auto ends = array_in<std::int32_t>(text, "offsets");
  const auto places = array_in<double>(text, "points");
  ASSERT_EQ(corners.size(), 4U * 9U);
  ASSERT_EQ(ends.size(), 9U);
  EXPECT_EQ(array_in<std::uint8_t>(text, "types"), std::vector<std::uint8_t>(9, 9));
  EXPECT_EQ(ends.back(), 36);
  for (std::size_t q = 0; q < 9; ++q) {
    double area = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto a = static_cast<std::size_t>(corners[4 * q + k]);
      const auto b = static_cast<std::size_t>(corners[4 * q + (k + 1) % 4]);
      area += 0.5 * (places[3 * a] * places[3 * b + 1] - places[3 * b] * places[3 * a + 1]);
    }
    EXPECT_NEAR(area, q < 8 ? 0.1 : 1.0, 1e-12) << q;
  }
  EXPECT_EQ(array_in<std::int32_t>(text, "flexure"),
            (std::vector<std::int32_t>{2, 2, 2, 2, 2, 2, 2, 2, 4}));
  const auto errors = array_in<double>(text, "error");
  ASSERT_EQ(errors.size(), 9U);
  EXPECT_DOUBLE_EQ(errors[0], 0.1);
  EXPECT_DOUBLE_EQ(errors[3], 0.1);
  EXPECT_DOUBLE_EQ(errors[4], 0.05);
  EXPECT_EQ(errors[8], 0.0);
}

TEST(WriteVtu, ASeriesNamesItsFiles) {
  const std::string text = make_pvd({"a & b.fields.000.vtu", "a & b.fields.001.vtu"}, {0.0, 0.05});
  EXPECT_NE(text.find(R"(timestep="0.05" part="0" file="a &amp; b.fields.001.vtu")"),
            std::string::npos);
}

/// A mesh has the pieces that it names, triangles among them.
TEST(WriteVtu, MeshesHaveTrianglesToo) {
  StressField mesh;
  mesh.drawn = mesh.places = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}, {2.0, 0.0}};
  mesh.stresses.resize(5);
  mesh.pieces = {{{0, 1, 2, 3}, 4, 0}, {{1, 4, 2, 2}, 3, 1}};
  mesh.error_energies = {0.0, 0.09};
  mesh.energy = 1.0;
  FieldState fields = two_strips();
  fields.flexures.push_back({5, mesh});
  const std::string text = make_vtu(fields, 1.0);
  EXPECT_EQ(number_in(text, "NumberOfPoints"), 24U);
  EXPECT_EQ(number_in(text, "NumberOfCells"), 11U);
  const auto corners = array_in<std::int32_t>(text, "connectivity");
  ASSERT_EQ(corners.size(), 4U * 10U + 3U);
  EXPECT_EQ(std::vector<std::int32_t>(corners.end() - 7, corners.end()),
            (std::vector<std::int32_t>{19, 20, 21, 22, 20, 23, 21}));
  EXPECT_EQ(array_in<std::uint8_t>(text, "types").back(), 5);
  EXPECT_EQ(array_in<std::int32_t>(text, "offsets").back(), 43);
  EXPECT_EQ(array_in<std::int32_t>(text, "flexure").back(), 5);
  // energies of all flexures together
  EXPECT_NEAR(array_in<double>(text, "error").back(), std::sqrt(0.09 / 5.0), 1e-12);
}

}  // namespace
}  // namespace flexura

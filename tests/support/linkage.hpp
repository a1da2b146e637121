#pragma once

#include "tests/support/mechanism.hpp"

namespace flexura::testing {

/// The four-bar of Turcic and Midha, Dynamic Analysis of Elastic Mechanism Systems, 1984, table 2,
/// in lbf, in, s: an elastic crank clamped to the driven body "shaft", links that meet at pins.
/// Drawn with the crank along x.
inline Mechanism turcic_midha_four_bar() {
  constexpr double gravity = 386.4;  // in/s2
  GeneralSection crank, link;
  crank.area = 0.167;
  crank.second_moment = 3.88e-4;
  crank.depth = 0.167;
  link.area = 0.063;
  link.second_moment = 2.08e-5;
  link.depth = 0.063;
  const Vec2 a{4.25, 0.0}, b{7.783913, 10.416883}, d{10.0, 0.0};
  Mechanism bar;
  bar.material(10.3e6, 0.33).density(0.098 / gravity).section(crank);
  bar.fixed("ground").body("shaft").centre({0.0, 0.0});
  bar.body("A").centre(a).mass(0.0976 / gravity).body("B").centre(b).mass(0.08112 / gravity);
  bar.flexure("shaft", "A", LineAxis{{0.0, 0.0}, a});
  bar.section(link);
  bar.flexure("A", "B", LineAxis{a, b}).pin_base().pin_action();
  bar.flexure("B", "ground", LineAxis{b, d}).pin_base().pin_action();
  bar.turn("shaft", 1.0, LinearHistory{});
  return bar;
}

}  // namespace flexura::testing

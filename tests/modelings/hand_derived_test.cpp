// Automatic differentiation against the same beams differentiated by hand.
#include "tests/support/hand_derived.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "flexura/modelings/beam.hpp"
#include "flexura/modelings/exact.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/mechanism.hpp"

namespace flexura::testing {
namespace {

/// An arc so thick that axial and shear strains count.
FlexureProperties thick_arc() {
  Mechanism m;
  m.material(2100.0, 0.35).section(RectangleSection{0.8, 1.0}).fixed("ground").body("tip");
  m.flexure("ground", "tip", ArcAxis{{0.0, 3.0}, 3.0, -std::numbers::pi / 2.0, 2.5});
  return flexure_properties(m, m.model().flexures[0], true, true);
}

const Eigen::Vector3d some_load{60.0, -45.0, 80.0};

/// Internal unknowns of order one tenth, no two alike: not in equilibrium, so that every term of
/// residual and tangent counts.
std::vector<double> some_state(std::size_t unknowns) {
  std::vector<double> y(unknowns);
  for (std::size_t i = 0; i < unknowns; ++i) y[i] = 0.1 * std::sin(1.7 * double(i) + 0.3);
  return y;
}

/// 1e-12 relative to the largest: both do some hundred additions and one elimination in double
/// precision, in different orders. A wrong sign or a term left out is of order one.
void expect_same(const TipResponse& ad, const std::vector<double>& ad_scratch,
                 const TipResponse& hand, const std::vector<double>& hand_scratch, std::size_t m) {
  const double tip = (ad.tip - hand.tip).norm() / hand.tip.norm();
  const double flexibility = (ad.flexibility - hand.flexibility).norm() / hand.flexibility.norm();
  const double energy = std::abs(ad.strain_energy / hand.strain_energy - 1.0);
  double largest[4] = {}, apart[4] = {};  // u, Z: the Newton step of the internal unknowns
  for (std::size_t i = 0; i < 4 * m; ++i) {
    largest[i % 4] = std::max(largest[i % 4], std::abs(hand_scratch[i]));
    apart[i % 4] = std::max(apart[i % 4], std::abs(ad_scratch[i] - hand_scratch[i]));
  }
  note_measured("tip", tip);
  note_measured("flexibility", flexibility);
  note_measured("energy", energy);
  note_measured("step", apart[0] / largest[0]);
  EXPECT_LT(tip, 1e-12);
  EXPECT_LT(flexibility, 1e-12);
  EXPECT_LT(energy, 1e-12);
  for (std::size_t c = 0; c < 4; ++c) EXPECT_LT(apart[c], 1e-12 * largest[c]) << "column " << c;
  EXPECT_EQ(ad.negative, hand.negative);
}

template <class Hand>
void compare(const TwoPort& port, const Hand& hand) {
  const std::size_t m = port.internal_size();
  ASSERT_EQ(hand.internal_size(), m);
  const std::vector<double> y = some_state(m);
  std::vector<double> ad_scratch(port.scratch_size()), hand_scratch(hand.scratch_size());
  const TipResponse ad = port.linearize(some_load, y.data(), ad_scratch.data());
  const TipResponse by_hand = hand.linearize(some_load, y.data(), hand_scratch.data());
  expect_same(ad, ad_scratch, by_hand, hand_scratch, m);
}

class HandDerivedModes : public ::testing::TestWithParam<int> {};

TEST_P(HandDerivedModes, ExactFlexureIsTheSame) {
  const FlexureProperties flexure = thick_arc();
  compare(*make_exact_port(flexure, ExactSettings{GetParam()}, 1e-8),
          HandDerivedExact(flexure, GetParam()));
}
INSTANTIATE_TEST_SUITE_P(Few, HandDerivedModes, ::testing::Values(3, 8, 15));

class HandDerivedOrder : public ::testing::TestWithParam<int> {};

TEST_P(HandDerivedOrder, DisplacementElementsAreTheSame) {
  const FlexureProperties flexure = thick_arc();
  compare(*make_beam_port(flexure, BeamSettings{3, GetParam()}),
          HandDerivedBeam(flexure, 3, GetParam()));
}
INSTANTIATE_TEST_SUITE_P(LowAndHigh, HandDerivedOrder, ::testing::Values(1, 2, 4));

}  // namespace
}  // namespace flexura::testing

#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "tests/support/mechanism.hpp"
#include "tests/support/modelings.hpp"

namespace flexura::testing {

/// A modeling's entry in the suite of properties: its settings, and the line that says which of the
/// properties that not all modelings share apply to it.
struct SuiteEntry {
  std::string name;
  ModelingSettings settings;
  bool curved = true;      ///< takes any axis; else straight ones only
  bool reversible = true;  ///< a flexure drawn from its other end answers alike
  bool divisible = true;   ///< two halves joined by a body answer as the whole
  bool linearizes = true;  ///< tends to the compliance matrix as loads vanish

  friend void PrintTo(const SuiteEntry& entry, std::ostream* out) { *out << entry.name; }
};

inline ModelingSettings no_strain(ModelingSettings settings) { return in_theory(settings, "i"); }

/// Su's and Howell's parameters are fits, unsymmetrical ones; SCMBM relates load and displacement
/// in the frame of its base body alone; neither it nor a pseudo-rigid chain is right at half its
/// length. Elements of the beam constraint model count from the frame of their base. Two halves of
/// a two-node mesh have other nodes than the whole. The faces of a continuum's halves are stiff,
/// and its compliance is not that of a beam.
inline std::vector<SuiteEntry> suite_entries() {
  const auto prbm_by = [](PrbmSettings parameters) { return no_strain(prbm(parameters)); };
  const PrbmSegments segments{{0.2, 0.3, 0.3, 0.2}, {3.0, 2.5, 3.0}};
  const PrbmJoints joints{{{-0.3, -0.05}, {0.0, 0.1}, {0.3, -0.05}}, {2.8, 3.1, 2.8}};
  ContinuumSettings neo_hookean;
  neo_hookean.law = ContinuumSettings::Law::neo_hookean;
  neo_hookean.elements = 8;
  neo_hookean.order = 3;
  ContinuumSettings contracting;
  contracting.contracting = true;
  contracting.elements = 30;
  contracting.order = 1;
  contracting.across = 2;
  const bool no = false;
  return {{"linear", linear()},
          {"scmbm_centre", scmbm_centre(), true, no, no},
          {"scmbm_end", scmbm_end(), true, no, no},
          {"prbm_equal", prbm_by({}), true, true, no},
          {"prbm_su", prbm_by({PrbmSu{}}), no, no, no, no},
          {"prbm_howell", prbm_by({PrbmHowell{0.0}}), no, no, no, no},
          {"prbm_segments", prbm_by({segments}), no, true, no, no},
          {"prbm_joints", prbm_by({joints}), true, true, no, no},
          {"exact", exact_modes(14)},
          {"exact_inextensible", no_strain(exact_modes(14))},
          {"exact_unshearable", in_theory(exact_modes(14), "ii")},
          {"beam_order_1", beam(16, 1), true, true, no, no},
          {"beam_order_4", beam(8, 4)},
          {"beam_order_4_inextensible", no_strain(beam(8, 4))},
          {"bcm", in_theory(bcm(), "ii"), no, no, no},
          {"bcm_chain", in_theory(bcm(4), "ii"), no, no, no},
          {"bcm_inextensible", no_strain(bcm()), no, no, no},
          {"von_karman", von_karman(16), true, true, no, no},
          {"von_karman_unshearable", in_theory(von_karman(16), "ii"), true, true, no, no},
          {"printed", in_theory(printed_beam(16), "ii"), no, true, no},
          {"linear_beam", linear_beam(8), true, true, no, no},
          {"continuum", continuum(8, 1, 4), true, true, no, no},
          {"continuum_four_node", continuum(40, 2, 1), true, true, no, no},
          {"continuum_neo_hookean", continuum(neo_hookean), true, true, no, no},
          {"continuum_contracting", continuum(contracting), true, true, no, no}};
}

/// A chain of two flexures, ground - link - stage, with the point "stage.P" off its last end; arcs
/// of 150 and -100 degrees, or straight leaves.
inline Mechanism suite_chain(const SuiteEntry& entry) {
  Mechanism chain;
  chain.material(2100.0, 0.35).section(RectangleSection{0.3, 1.0});
  chain.fixed("ground").body("link").body("stage").point("P", {14.0, 9.0});
  if (entry.curved) {
    chain.flexure("ground", "link", ArcAxis{{0.0, 3.0}, 3.0, -1.5, 2.6});
    chain.flexure("link", "stage", ArcAxis{{8.0, 6.0}, 4.0, 3.0, -1.75});
  } else {
    chain.flexure("ground", "link", LineAxis{{0.0, 0.0}, {6.0, 2.0}});
    chain.flexure("link", "stage", LineAxis{{7.0, 3.0}, {11.0, 9.0}});
  }
  return chain;
}

/// Loads that turn the stage by some tenths of a radian: a force at the point and a moment on the
/// body between.
inline std::vector<Load> suite_loads(const Mechanism& chain) {
  return {chain.load("stage.P", {0.06, 0.09}), chain.load("link", {0.03, -0.02}, 0.25)};
}

inline std::string suite_name(const ::testing::TestParamInfo<SuiteEntry>& test) {
  return test.param.name;
}

}  // namespace flexura::testing

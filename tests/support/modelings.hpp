#pragma once

#include <string>
#include <vector>

#include "flexura/model/modeling_settings.hpp"

namespace flexura::testing {

inline ModelingSettings settings_of(ModelingSettings::Kind kind, std::string label,
                                    double tolerance = 1e-8) {
  ModelingSettings settings;
  settings.kind = std::move(kind);
  settings.label = std::move(label);
  settings.tolerance = tolerance;
  return settings;
}

inline ModelingSettings linear() { return settings_of(LinearSettings{}, "linear"); }
inline ModelingSettings scmbm_centre() {
  return settings_of(ScmbmSettings{ScmbmSettings::At::centre}, "scmbm", 1e-11);
}
inline ModelingSettings scmbm_end() {
  return settings_of(ScmbmSettings{ScmbmSettings::At::end}, "scmbm_end", 1e-11);
}
inline ModelingSettings prbm(PrbmSettings parameters = {}) {
  return settings_of(std::move(parameters), "prbm", 1e-11);
}
/// Modes chosen from the tolerance.
inline ModelingSettings exact(double tolerance = 1e-10) {
  return settings_of(ExactSettings{}, "exact", tolerance);
}
inline ModelingSettings exact_modes(int modes) {
  return settings_of(ExactSettings{modes}, "exact_" + std::to_string(modes), 1e-11);
}
inline ModelingSettings beam(int elements, int order) {
  return settings_of(BeamSettings{elements, order, BeamSettings::Theory::exact}, "beam", 1e-11);
}
inline ModelingSettings von_karman(int elements) {
  return settings_of(BeamSettings{elements, 1, BeamSettings::Theory::von_karman}, "von_karman",
                     1e-11);
}
inline ModelingSettings printed_beam(int elements) {
  return settings_of(BeamSettings{elements, 1, BeamSettings::Theory::printed}, "printed", 1e-11);
}
inline ModelingSettings linear_beam(int elements) {
  return settings_of(BeamSettings{elements, 1, BeamSettings::Theory::linear}, "linear_beam", 1e-11);
}
inline ModelingSettings bcm(int elements = 1) {
  return settings_of(BcmSettings{elements}, "bcm", 1e-11);
}

inline ModelingSettings continuum(const ContinuumSettings& settings, double tolerance = 1e-11) {
  return settings_of(settings, "continuum", tolerance);
}
/// Elements of one order both ways.
inline ModelingSettings continuum(int elements, int across, int order) {
  ContinuumSettings settings;
  settings.elements = elements;
  settings.across = across;
  settings.order = order;
  return continuum(settings);
}

/// The reference solutions' theories: i without axial and shear strain, ii without shear strain,
/// iii with both.
inline ModelingSettings in_theory(ModelingSettings settings, const std::string& theory) {
  settings.axial = theory != "i";
  settings.shear = theory == "iii";
  return settings;
}

}  // namespace flexura::testing

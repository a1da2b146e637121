#include <fmt/format.h>

#include <optional>

#include "flexura/core/units.hpp"
#include "flexura/model/validation.hpp"

namespace flexura {
namespace {

/// From the softest gels to a little beyond diamond (1.2e12 Pa).
constexpr double softest = 1e4, stiffest = 2e12;  // Pa

bool is_plausible(double pascals) { return pascals >= softest && pascals <= stiffest; }

/// 1 Pa in the declared units.
std::optional<double> pascal_in(const UnitNames& names) {
  const UnitReading length = read_unit(names.length);
  const UnitReading force = read_unit(names.force);
  const UnitReading time = read_unit(names.time);
  if (!length.unit || length.unit->dimension != dimensions::length) return {};
  if (!force.unit || force.unit->dimension != dimensions::force) return {};
  if (!time.unit || time.unit->dimension != dimensions::time) return {};
  const UnitSystem units(*length.unit, *force.unit, *time.unit, Unit{dimensions::angle, {}});
  return units.value_of({"1", *read_unit("Pa").unit});
}

/// "210 GPa"
std::string stress_text(double pascals) {
  if (pascals >= 1e9) return fmt::format("{:.4g} GPa", pascals / 1e9);
  if (pascals >= 1e6) return fmt::format("{:.4g} MPa", pascals / 1e6);
  return fmt::format("{:.4g} Pa", pascals);
}

/// A number that would be plausible in Pa most likely is in Pa.
std::string doubt_about(double modulus, double pascal, const UnitNames& names) {
  const double meant = is_plausible(modulus) ? modulus : 210e9;
  return fmt::format(
      "{:.4g} Pa in SI units, {} than any material; a number without a unit counts in {}/{}^2, "
      "where "
      "{} is {:.6g}: write \"{}\" {}",
      modulus / pascal, modulus / pascal > stiffest ? "stiffer" : "softer", names.force,
      names.length, stress_text(meant), meant * pascal, stress_text(meant),
      meant == modulus ? "if that is meant" : "or the like, with its unit");
}

}  // namespace

std::vector<Mistake> find_doubts(const Model& model) {
  std::vector<Mistake> doubts;
  const std::optional<double> pascal = pascal_in(model.units);
  if (!pascal) return doubts;
  for (const Material& material : model.materials) {
    const double modulus = material.youngs_modulus;
    if (!(modulus > 0.0) || is_plausible(modulus / *pascal)) continue;
    doubts.push_back({{"materials", material.name, "youngs_modulus"},
                      doubt_about(modulus, *pascal, model.units)});
  }
  return doubts;
}

}  // namespace flexura

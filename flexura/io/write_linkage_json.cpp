#include <complex>

#include "flexura/io/summary_json.hpp"
#include "flexura/results/linkage_peaks.hpp"

namespace flexura::summary {
namespace {

/// Radians throughout: as in all of the summary.
Json peak_json(const CurvePeak& peak) { return {{"value", peak.value}, {"angle", peak.angle}}; }

}  // namespace

void add_linkage(Json& json, const LinkageResult& linkage) {
  json["driver"] = linkage.driver;
  json["angular_speed"] = linkage.speed;
  json["modeling"] = linkage.modeling;
  json["damping"] = linkage.damping;
  if (!linkage.grashof.empty()) json["linkage"] = linkage.grashof;
  Json& bands = json["frequencies"] = Json::array();
  for (const FrequencyBand& band : frequency_bands(linkage))
    bands.push_back({{"least", band.least}, {"greatest", band.greatest}});
  Json& multipliers = json["floquet_multipliers"] = Json::array();
  for (const std::complex<double>& value : linkage.multipliers)
    multipliers.push_back({{"real", value.real()}, {"imaginary", value.imag()}});
  json["buckling_factor"] = optional_number(linkage.buckling_factor);
  if (linkage.buckling_factor) json["buckling_angle"] = linkage.buckling_angle;
  json["notes"] = linkage.notes;
}

Json linkage_json(const LinkageResult& linkage, const LinkageMotion& motion) {
  Json json = {{"modeling", linkage.modeling}};
  add_termination(json, motion.termination);
  json["unknowns"] = motion.unknowns;
  json["steps"] = static_cast<int>(linkage.positions.size()) - 1;
  json["iterations"] = motion.iterations;
  if (!motion.counted.empty()) json["counted"] = motion.counted;
  json["seconds"] = motion.seconds;
  json["error_estimate"] = optional_number(motion.error_estimate);
  json["difference"] = optional_number(motion.difference);
  if (!motion.remark.empty()) json["remark"] = motion.remark;
  for (std::size_t k = 0; k < motion.flexures.size(); ++k) {
    const FlexureCurves& curves = motion.flexures[k];
    json["peaks"][linkage.flexures[k]] = {
        {"strain", peak_json(find_peak(linkage, curves.strain))},
        {"deflection", peak_json(find_peak(linkage, curves.deflection))},
        {"stress", peak_json(find_peak(linkage, curves.stress))}};
  }
  return json;
}

}  // namespace flexura::summary

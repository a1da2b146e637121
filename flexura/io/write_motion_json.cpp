#include <numbers>

#include "flexura/io/summary_json.hpp"
#include "flexura/results/response_peaks.hpp"

namespace flexura::summary {

Json motion_json(const MotionResult& motion, const ModelingMotion& modeling) {
  Json json = {{"modeling", modeling.modeling}};
  add_termination(json, modeling.termination);
  json["unknowns"] = modeling.unknowns;
  json["steps"] = modeling.steps;
  json["rejected"] = modeling.rejected;
  json["iterations"] = modeling.iterations;
  json["seconds"] = modeling.seconds;
  json["smallest_step"] = modeling.smallest_step;
  json["largest_step"] = modeling.largest_step;
  json["energy_error"] = modeling.energy_error;
  json["error_estimate"] = optional_number(modeling.error_estimate);
  json["difference"] = optional_number(modeling.difference);
  json["extremes"] = extremes_json(motion, modeling);
  if (const auto peak = find_largest_stress(modeling)) {
    json["largest_stress"] = {
        {"value", peak->stress}, {"time", peak->time}, {"flexure", motion.flexures[peak->flexure]}};
  }
  if (const auto safety = find_safety(motion, modeling))
    json["safety"] = safety_json(motion, *safety, "time");
  return json;
}

Json response_json(const ResponseResult& response, const ModelingResponse& modeling) {
  Json json = {{"modeling", modeling.modeling}};
  add_termination(json, modeling.termination);
  json["unknowns"] = modeling.unknowns;
  json["seconds"] = modeling.seconds;
  json["error_estimate"] = optional_number(modeling.error_estimate);
  json["difference"] = optional_number(modeling.difference);
  Json& peaks = json["peaks"] = Json::array();
  for (std::size_t place = 0; place < response.places.size(); ++place) {
    for (const ResponsePeak& peak : find_peaks(response, modeling, place)) {
      peaks.push_back({{"place", response.places[place]},
                       {"frequency", peak.angular_frequency / (2.0 * std::numbers::pi)},
                       {"amplitude", peak.amplitude}});
    }
  }
  return json;
}

}  // namespace flexura::summary

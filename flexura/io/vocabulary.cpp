#include "flexura/io/vocabulary.hpp"

#include <map>

namespace flexura::vocabulary {

const Vocabulary& model() {
  static const Vocabulary v{{"flexura", "title", "units", "parameters", "materials", "sections",
                             "bodies", "flexures", "springs", "joints", "drivers", "studies"},
                            {}};
  return v;
}

const Vocabulary& units() {
  static const Vocabulary v{{"length", "force", "time", "angle"}, {}};
  return v;
}

const Vocabulary& material() {
  static const Vocabulary v{
      {"youngs_modulus", "poissons_ratio", "density", "strength", "thermal_expansion"}, {}};
  return v;
}

const Vocabulary& section() {
  static const Vocabulary v{{"rectangle", "circle", "general"}, {}};
  return v;
}

const Vocabulary& rectangle() {
  static const Vocabulary v{{"thickness", "width", "profile", "width_profile"}, {}};
  return v;
}

const Vocabulary& circle() {
  static const Vocabulary v{{"diameter", "profile"}, {}};
  return v;
}

const Vocabulary& profile() {
  static const Vocabulary v{
      {"leaf", "taper", "piecewise", "circular", "elliptic", "corner_filleted"}, {}};
  return v;
}

const Vocabulary& no_keys() {
  static const Vocabulary v{{}, {}};
  return v;
}

const Vocabulary& taper() {
  static const Vocabulary v{{"end"}, {}};
  return v;
}

const Vocabulary& round() {
  static const Vocabulary v{{"radius"}, {}};
  return v;
}

const Vocabulary& elliptic() {
  static const Vocabulary v{{"a", "b"}, {}};
  return v;
}

const Vocabulary& general() {
  static const Vocabulary v{
      {"area", "second_moment", "shear_area", "depth", "rotary_second_moment"}, {"profile"}};
  return v;
}

const Vocabulary& body() {
  static const Vocabulary v{{"fixed", "free", "points", "centre", "mass", "inertia"}, {}};
  return v;
}

const Vocabulary& flexure() {
  static const Vocabulary v{{"between", "pinned", "axis", "material", "section", "mesh", "outline",
                             "misfit", "misfit_rotation"},
                            {}};
  return v;
}

const Vocabulary& mesh() {
  static const Vocabulary v{{"file", "part", "base", "action", "depth", "unit"}, {}};
  return v;
}

const Vocabulary& outline() {
  static const Vocabulary v{{"border", "holes", "base", "action", "depth", "size", "order"}, {}};
  return v;
}

const Vocabulary& outline_side() {
  static const Vocabulary v{{"to", "sweep", "fillet", "edge"}, {}};
  return v;
}

const Vocabulary& outline_hole() {
  static const Vocabulary v{{"centre", "radius", "border", "edge"}, {}};
  return v;
}

const Vocabulary& spring() {
  static const Vocabulary v{
      {"between", "stiffness", "torsional", "damping", "free_length", "free_angle", "preload"}, {}};
  return v;
}

const Vocabulary& joint() {
  static const Vocabulary v{{"revolute", "prismatic", "at"}, {}};
  return v;
}

const Vocabulary& prismatic() {
  static const Vocabulary v{{"bodies", "direction"}, {}};
  return v;
}

const Vocabulary& driver() {
  static const Vocabulary v{{"turn", "move", "direction", "speed", "angle", "distance", "history"},
                            {}};
  return v;
}

const Vocabulary& history() {
  static const Vocabulary v{
      {"step", "ramp", "half_sine", "harmonic", "table", "file", "smooth", "time", "value"}, {}};
  return v;
}

const Vocabulary& half_sine() {
  static const Vocabulary v{{"start", "duration"}, {}};
  return v;
}

const Vocabulary& harmonic() {
  static const Vocabulary v{{"frequency", "phase"}, {}};
  return v;
}

const Vocabulary& axis() {
  static const Vocabulary v{{"line", "arc", "spline", "start_tangent", "end_tangent"}, {}};
  return v;
}

const Vocabulary& arc() {
  static const Vocabulary v{{"centre", "radius", "start", "sweep"}, {}};
  return v;
}

const Vocabulary& linear_study() {
  static const Vocabulary v{{"kind", "loads", "axial", "shear"}, {"about"}};
  return v;
}

const Vocabulary& path_study() {
  static const Vocabulary v{
      {"kind", "loads", "gravity", "temperature", "surroundings", "prescribe", "control", "until",
       "branch", "steps", "stage", "condense", "fields", "estimate", "modelings", "reference"},
      {}};
  return v;
}

const Vocabulary& stage() {
  static const Vocabulary v{{"on", "along", "input", "input_along"}, {}};
  return v;
}

const Vocabulary& buckling_study() {
  static const Vocabulary v{{"kind", "loads", "linearised", "count", "modelings", "reference"}, {}};
  return v;
}

const Vocabulary& inverse_study() {
  static const Vocabulary v{{"kind", "relative", "steps", "modelings", "reference"}, {}};
  return v;
}

const Vocabulary& modes_study() {
  static const Vocabulary v{
      {"kind", "about", "count", "solver", "rotary_inertia", "shear_rotary_inertia",
       "translation_inertia", "mass", "modelings", "reference"},
      {}};
  return v;
}

const Vocabulary& transient_study() {
  static const Vocabulary v{{"kind",
                             "loads",
                             "gravity",
                             "temperature",
                             "prescribe",
                             "from",
                             "duration",
                             "step",
                             "tolerance",
                             "method",
                             "spectral_radius",
                             "outputs",
                             "estimate",
                             "damping",
                             "rotary_inertia",
                             "shear_rotary_inertia",
                             "translation_inertia",
                             "mass",
                             "modelings",
                             "reference"},
                            {}};
  return v;
}

const Vocabulary& response_study() {
  static const Vocabulary v{
      {"kind", "loads", "about", "frequencies", "damping", "rotary_inertia", "shear_rotary_inertia",
       "translation_inertia", "mass", "modelings", "reference"},
      {}};
  return v;
}

const Vocabulary& linkage_study() {
  static const Vocabulary v{
      {"kind", "driver", "loads", "gravity", "positions", "elements", "modeling", "methods",
       "coupling", "geometric_stiffness", "damping", "rotary_inertia", "inertia_correction",
       "speed_fluctuation", "speeds", "modes", "midha", "turns", "turn_from_rest"},
      {}};
  return v;
}

const Vocabulary& speed_harmonic() {
  static const Vocabulary v{{"order", "amplitude", "phase"}, {}};
  return v;
}

const Vocabulary& speeds() {
  static const Vocabulary v{{"from", "to", "count"}, {}};
  return v;
}

const Vocabulary& midha() {
  static const Vocabulary v{{"modes", "continuity"}, {}};
  return v;
}

const Vocabulary& linkage_methods() {
  static const Vocabulary v{{"quasi_static", "periodic", "midha", "transient", "nonlinear"}, {}};
  return v;
}

const Vocabulary& geometric_stiffness() {
  static const Vocabulary v{{"none", "quasi_static", "dynamic"}, {}};
  return v;
}

const Vocabulary& continuities() {
  static const Vocabulary v{{"physical", "modal"}, {}};
  return v;
}

const Vocabulary& modes_about() {
  static const Vocabulary v{{"study", "load_factor", "curve"}, {}};
  return v;
}

const Vocabulary& study_state() {
  static const Vocabulary v{{"study", "load_factor"}, {}};
  return v;
}

const Vocabulary& frequencies() {
  static const Vocabulary v{{"from", "to", "count", "logarithmic"}, {}};
  return v;
}

const Vocabulary& damping() {
  static const Vocabulary v{{"modal", "mass", "stiffness"}, {}};
  return v;
}

const Vocabulary& load() {
  static const Vocabulary v{
      {"on", "force", "moment", "follower", "constant", "distributed", "history", "angle"}, {}};
  return v;
}

const Vocabulary& until() {
  static const Vocabulary v{{"load_factor", "limit_points", "steps"}, {}};
  return v;
}

const Vocabulary& branch() {
  static const Vocabulary v{{"at", "side"}, {}};
  return v;
}

const Vocabulary& controls() {
  static const Vocabulary v{{"load", "arc_length"}, {}};
  return v;
}

const Vocabulary& prescribed() {
  static const Vocabulary v{{"on", "x", "y", "rotation", "history"}, {}};
  return v;
}

const Vocabulary& relative() {
  static const Vocabulary v{{"flexure", "x", "y", "rotation", "at"}, {}};
  return v;
}

const Vocabulary& modeling(const std::string& modeling) {
  const auto with = [](std::vector<std::string> own) {
    std::vector<std::string> keys = {"name", "label", "axial", "shear", "tolerance"};
    keys.insert(keys.end(), own.begin(), own.end());
    return Vocabulary{keys, {}};
  };
  static const Vocabulary common = with({});
  static const std::map<std::string, Vocabulary> particular = {
      {"scmbm", with({"at"})},
      {"prbm", with({"parameters"})},
      {"exact", with({"modes"})},
      {"beam", with({"theory", "elements", "order"})},
      {"bcm", with({"elements"})},
      {"continuum",
       with({"elements", "across", "order", "order_across", "plane", "law", "enhanced", "ends"})}};
  const auto at = particular.find(modeling);
  return at == particular.end() ? common : at->second;
}

const Vocabulary& prbm_parameters() {
  static const Vocabulary v{{"model", "load_ratio", "lengths", "joints", "stiffness"}, {}};
  return v;
}

const Vocabulary& study_kinds() {
  static const Vocabulary v{
      {"linear", "path", "buckling", "inverse", "modes", "transient", "response", "linkage"}, {}};
  return v;
}

const Vocabulary& methods() {
  static const Vocabulary v{{"radau", "generalized_alpha", "energy_momentum"}, {}};
  return v;
}

const Vocabulary& mode_solvers() {
  static const Vocabulary v{{"automatic", "dense", "sparse"}, {}};
  return v;
}

const Vocabulary& masses() {
  static const Vocabulary v{{"consistent", "lumped"}, {}};
  return v;
}

const Vocabulary& modelings() {
  static const Vocabulary v{{"linear", "scmbm", "prbm", "exact", "beam", "bcm", "continuum"}, {}};
  return v;
}

const Vocabulary& planes() {
  static const Vocabulary v{{"stress", "strain"}, {}};
  return v;
}

const Vocabulary& laws() {
  static const Vocabulary v{{"st_venant_kirchhoff", "neo_hookean"}, {}};
  return v;
}

const Vocabulary& face_ends() {
  static const Vocabulary v{{"rigid", "contracting"}, {}};
  return v;
}

const Vocabulary& parameter_sets() {
  static const Vocabulary v{{"equal_springs", "su", "howell"}, {}};
  return v;
}

const Vocabulary& theories() {
  static const Vocabulary v{
      {"exact", "von_karman", "linear", "euler_bernoulli", "timoshenko", "printed"}, {}};
  return v;
}

}  // namespace flexura::vocabulary

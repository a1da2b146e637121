// Prints the tables of docs/prbm.md: how far a pseudo-rigid-body model of one flexure is from the
// exact flexure, by arc angle and load. The flexure has unit length and bending stiffness, is
// clamped at its base and loaded at its end; every load is scaled until the exact end has turned by
// the given angle.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "flexura/studies/path_tracer.hpp"

namespace {

using namespace flexura;

constexpr double pi = std::numbers::pi;

/// A cantilever of unit length; an arc of angle 0 is straight, along x. Symmetric about the y axis.
Model make_cantilever(double arc_angle) {
  Model model;
  model.units = {"m", "N", "s", "rad"};
  Material material;
  material.youngs_modulus = 1.0;
  model.materials.push_back(material);
  model.sections.push_back({"unit", GeneralSection{1.0, 1.0, {}, {}, {}}, {}});
  model.bodies.resize(2);
  model.bodies[0].fixed = true;
  Flexure flexure;
  flexure.base = 0;
  flexure.action = 1;
  if (arc_angle == 0.0) {
    flexure.axis = LineAxis{{-0.5, 0.0}, {0.5, 0.0}};
  } else {
    const double radius = 1.0 / arc_angle;
    flexure.axis = ArcAxis{{0.0, 0.0}, radius, 0.5 * (pi + arc_angle), -arc_angle};
  }
  model.flexures.push_back(flexure);
  return model;
}

struct LoadCase {
  std::string name;
  Vec2 force;
  double moment;
};

const std::vector<LoadCase> load_cases = {
    {"moment +", {0.0, 0.0}, 1.0},  {"moment -", {0.0, 0.0}, -1.0}, {"force +y", {0.0, 1.0}, 0.0},
    {"force -y", {0.0, -1.0}, 0.0}, {"force +x", {1.0, 0.0}, 0.0},  {"force -x", {-1.0, 0.0}, 0.0}};

ModelingSettings bending_alone(ModelingSettings::Kind kind) {
  ModelingSettings settings;
  settings.kind = std::move(kind);
  settings.axial = false;
  settings.shear = false;
  return settings;
}

/// Pose of the end under a load, if the whole of it is carried.
std::optional<Pose> end_pose(const Model& model, const LoadCase& load, double size,
                             const ModelingSettings& settings) {
  Load full;
  full.body = 1;
  full.force = size * load.force;
  full.moment = size * load.moment;
  const TracedPath path = trace_path(model, {full}, settings, {16, false, {}});
  if (!path.termination.converged()) return {};
  const TracedState& last = path.states.back();
  return path.systems[last.system]->pose(1, last.z);
}

/// The load's size at which the exact end has turned by `angle`; absent where it never does.
std::optional<double> size_for(const Model& model, const LoadCase& load, double angle) {
  const ModelingSettings exact = bending_alone(ExactSettings{});
  const auto turned_past = [&](double size) {
    const auto pose = end_pose(model, load, size, exact);
    return pose && std::abs(pose->rotation) > angle;
  };
  double high = 0.25;
  while (!turned_past(high)) {
    high *= 1.5;
    if (high > 60.0) return {};
  }
  double low = 0.0;
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (low + high);
    (turned_past(middle) ? high : low) = middle;
  }
  return high;
}

std::string error_at(const Model& model, const LoadCase& load, double angle,
                     const PrbmSettings& prbm) {
  const auto size = size_for(model, load, angle);
  if (!size) return "-";
  const auto exact = end_pose(model, load, *size, bending_alone(ExactSettings{}));
  const auto other = end_pose(model, load, *size, bending_alone(prbm));
  if (!exact || !other) return "-";
  const Vec2 start = body_centre(model, 1);
  const double error = norm(other->position - exact->position) / norm(exact->position - start);
  return fmt::format("{:.2f}", 100.0 * error);
}

void print_table(const std::string& title, const std::vector<double>& degrees,
                 const PrbmSettings& prbm) {
  fmt::print("{}\n\n| arc | end turns by |", title);
  for (const LoadCase& load : load_cases) fmt::print(" {} |", load.name);
  fmt::print("\n| --- | --- |");
  for (std::size_t k = 0; k < load_cases.size(); ++k) fmt::print(" --- |");
  fmt::print("\n");
  for (const double degree : degrees)
    for (const double angle : {0.25, 0.5, 1.0}) {
      const Model model = make_cantilever(degree * pi / 180.0);
      fmt::print("| {:.0f} deg | {:.2f} rad |", degree, angle);
      for (const LoadCase& load : load_cases)
        fmt::print(" {} |", error_at(model, load, angle, prbm));
      fmt::print("\n");
    }
  fmt::print("\n");
}

}  // namespace

int main() {
  fmt::print("Distance of the end from the exact one, % of its displacement.\n\n");
  print_table("Equal springs", {0.0, 60.0, 120.0, 180.0, 240.0, 300.0}, {PrbmEqualSprings{}});
  print_table("Su's 3R", {0.0}, {PrbmSu{}});
  print_table("Howell's 1R", {0.0}, {PrbmHowell{}});
  return 0;
}

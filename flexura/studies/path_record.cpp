#include "flexura/studies/path_record.hpp"

#include <algorithm>
#include <cmath>

namespace flexura {
namespace {

/// From axes of a flexure's base section to the global ones.
class ToGlobal {
 public:
  ToGlobal(const MechanismState& state, std::size_t member)
      : base_(state.base_section(member)), linearised_(state.linearised()) {}

  Vec2 point(Vec2 local, Vec2 drawn) const {
    if (!linearised_) return base_.position + rotate(base_.rotation, local);
    return base_.position + local + base_.rotation * perp(drawn);
  }
  double rotation(double local) const { return base_.rotation + local; }

 private:
  Pose base_;
  bool linearised_;
};

struct DrawnSections {
  std::vector<SectionState> now;
  std::vector<SectionState> before;  // of the unloaded flexure, where kinematics are linearised
};

DrawnSections sections_of(const MechanismState& state, std::size_t member) {
  DrawnSections sections{state.sections(member), {}};
  if (state.linearised()) sections.before = state.drawn_sections(member);
  return sections;
}

Vec2 drawn_place(const DrawnSections& sections, std::size_t k) {
  return sections.before.empty() ? Vec2{} : sections.before[k].pose.position;
}

/// The largest fibre stress at the stations of a flexure; 0 in links of any shape, which have no
/// fibres: what counts of them is the largest von Mises stress of their field.
class FibreStress {
 public:
  FibreStress(const Model& model, std::size_t flexure)
      : has_fibres_(!model.flexures[flexure].link),
        shape_(section_of(model, model.flexures[flexure])),
        varies_(section_varies(shape_)),
        length_(AxisCurve(model.flexures[flexure].axis).length()),
        section_(section_properties(shape_)) {}

  double operator()(const SectionState& state, double s) const {
    if (!has_fibres_) return 0.0;
    const SectionProperties section = varies_ ? section_properties(shape_, s, length_) : section_;
    const double modulus = section.second_moment / (0.5 * section.depth);
    return std::abs(state.axial_force) / section.area + std::abs(state.bending_moment) / modulus;
  }

  double largest(const std::vector<SectionState>& sections) const {
    double most = 0.0;
    for (std::size_t i = 0; i < sections.size(); ++i)
      most = std::max(most, (*this)(sections[i], at(i, sections.size())));
    return most;
  }

  /// Arc length at station i of `stations`.
  double at(std::size_t i, std::size_t stations) const {
    return length_ * static_cast<double>(i) / static_cast<double>(stations - 1);
  }

 private:
  bool has_fibres_;
  Section shape_;
  bool varies_;
  double length_;
  SectionProperties section_;
};

double largest_von_mises(const StressField& field) {
  double largest = 0.0;
  for (const PlaneStress& stress : field.stresses)
    largest = std::max(largest, von_mises_stress(stress));
  return largest;
}

}  // namespace

PathState make_path_state(const Model& model, const MechanismState& mechanism, double load_factor) {
  PathState state;
  state.load_factor = load_factor;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].fixed) continue;
    state.bodies.push_back(mechanism.pose(b));
    for (const Point& point : model.bodies[b].points)
      state.points.push_back(mechanism.moved_point(b, point.position));
  }
  for (std::size_t k = 0; k < model.flexures.size(); ++k) {
    const ToGlobal to_global(mechanism, k);
    const DrawnSections sections = sections_of(mechanism, k);
    const std::size_t middle = sections.now.size() / 2;
    const Pose& mid = sections.now[middle].pose;
    state.mids.push_back({to_global.point(mid.position, drawn_place(sections, middle)),
                          to_global.rotation(mid.rotation)});
    std::vector<Vec2> axis = mechanism.drawn_axis(k, sections.now);
    for (std::size_t i = 0; i < axis.size(); ++i)
      axis[i] = to_global.point(axis[i], drawn_place(sections, i));
    state.axes.push_back(std::move(axis));
    const auto field = model.flexures[k].link ? mechanism.stress_field(k) : std::nullopt;
    state.peak_stresses.push_back(field ? largest_von_mises(*field)
                                        : FibreStress(model, k).largest(sections.now));
  }
  return state;
}

PathState make_path_state(const Model& model, const System& system, const std::vector<double>& z,
                          double load_factor) {
  return make_path_state(model, StillState(system, z), load_factor);
}

std::vector<std::vector<MemberStation>> make_members(const Model& model,
                                                     const MechanismState& mechanism) {
  std::vector<std::vector<MemberStation>> members;
  for (std::size_t k = 0; k < model.flexures.size(); ++k) {
    const ToGlobal to_global(mechanism, k);
    const DrawnSections sections = sections_of(mechanism, k);
    const FibreStress stress(model, k);
    std::vector<MemberStation> stations;
    for (std::size_t i = 0; i < sections.now.size(); ++i) {
      const SectionState& s = sections.now[i];
      const double at = stress.at(i, sections.now.size());
      stations.push_back({at,
                          {to_global.point(s.pose.position, drawn_place(sections, i)),
                           to_global.rotation(s.pose.rotation)},
                          s.axial_force,
                          s.shear_force,
                          s.bending_moment,
                          stress(s, at)});
    }
    members.push_back(std::move(stations));
  }
  return members;
}

std::vector<std::vector<MemberStation>> make_members(const Model& model, const System& system,
                                                     const std::vector<double>& z) {
  return make_members(model, StillState(system, z));
}

PathResult make_path_names(const Model& model) {
  PathResult names;
  for (const Body& body : model.bodies) {
    if (body.fixed) continue;
    names.bodies.push_back(body.name);
    for (const Point& point : body.points) names.points.push_back(body.name + "." + point.name);
  }
  for (const Flexure& flexure : model.flexures) {
    names.flexures.push_back(flexure.name);
    names.strengths.push_back(model.materials[flexure.material].strength);
  }
  return names;
}

}  // namespace flexura

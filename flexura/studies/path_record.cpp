#include "flexura/studies/path_record.hpp"

#include <algorithm>
#include <cmath>

namespace flexura {
namespace {

/// From axes of a flexure's base section to the global ones.
class ToGlobal {
 public:
  ToGlobal(const System& system, std::size_t member, const std::vector<double>& z)
      : base_(system.base_section(member, z)), linearised_(system.linearised()) {}

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

DrawnSections sections_of(const System& system, std::size_t member, const std::vector<double>& z) {
  const TwoPort& port = *system.layout().members[member].port;
  DrawnSections sections{
      port.sections_in(system.surroundings(member, z), system.member_load(member, z),
                       system.internal(member, z)),
      {}};
  if (system.linearised()) {
    const std::vector<double> rest(port.internal_size(), 0.0);
    sections.before = port.sections(Eigen::Vector3d::Zero(), rest);
  }
  return sections;
}

Vec2 drawn_place(const DrawnSections& sections, std::size_t k) {
  return sections.before.empty() ? Vec2{} : sections.before[k].pose.position;
}

/// The largest fibre stress at the stations of a flexure.
class FibreStress {
 public:
  FibreStress(const Model& model, const System& system, std::size_t flexure)
      : shape_(model.sections[model.flexures[flexure].section].shape),
        varies_(section_varies(shape_)),
        length_(system.layout().members[flexure].length),
        section_(section_properties(shape_)) {}

  double operator()(const SectionState& state, double s) const {
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
  const Section& shape_;
  bool varies_;
  double length_;
  SectionProperties section_;
};

}  // namespace

PathState make_path_state(const Model& model, const System& system, const std::vector<double>& z,
                          double load_factor) {
  PathState state;
  state.load_factor = load_factor;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].fixed) continue;
    state.bodies.push_back(system.pose(b, z));
    for (const Point& point : model.bodies[b].points)
      state.points.push_back(system.moved_point(b, point.position, z));
  }
  for (std::size_t k = 0; k < model.flexures.size(); ++k) {
    const ToGlobal to_global(system, k, z);
    const DrawnSections sections = sections_of(system, k, z);
    const std::size_t middle = sections.now.size() / 2;
    const Pose& mid = sections.now[middle].pose;
    state.mids.push_back({to_global.point(mid.position, drawn_place(sections, middle)),
                          to_global.rotation(mid.rotation)});
    std::vector<Vec2> axis =
        system.layout().members[k].port->drawn_axis(sections.now, system.internal(k, z));
    for (std::size_t i = 0; i < axis.size(); ++i)
      axis[i] = to_global.point(axis[i], drawn_place(sections, i));
    state.axes.push_back(std::move(axis));
    state.peak_stresses.push_back(FibreStress(model, system, k).largest(sections.now));
  }
  return state;
}

std::vector<std::vector<MemberStation>> make_members(const Model& model, const System& system,
                                                     const std::vector<double>& z) {
  std::vector<std::vector<MemberStation>> members;
  for (std::size_t k = 0; k < model.flexures.size(); ++k) {
    const ToGlobal to_global(system, k, z);
    const DrawnSections sections = sections_of(system, k, z);
    const FibreStress stress(model, system, k);
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

#include "flexura/studies/drawing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "flexura/assembly/two_port.hpp"

namespace flexura {
namespace {

/// So many pieces of a history that its swings can be told apart, within what a page can carry.
std::size_t count_pieces(const TimeHistory& history, double end) {
  constexpr double least = 480.0;
  constexpr double most = 9600.0;
  constexpr double per_cycle = 24.0;
  double wanted = least;
  if (const auto* harmonic = std::get_if<HarmonicHistory>(&history))
    wanted = per_cycle * std::abs(harmonic->angular_frequency) * end / (2.0 * std::numbers::pi);
  if (const auto* half = std::get_if<HalfSineHistory>(&history))
    wanted = per_cycle * end / half->duration;
  if (const auto* table = std::get_if<TableHistory>(&history))
    wanted = 2.0 * static_cast<double>(table->times().size());
  return static_cast<std::size_t>(std::clamp(wanted, least, most));
}

/// Nothing of what is there from the start on.
std::optional<DrawnHistory> follow_history(const TimeHistory& history, double end) {
  DrawnHistory drawn{describe_history(history), end, {}};
  if (drawn.words.empty()) return {};
  const std::size_t pieces = count_pieces(history, end);
  for (std::size_t k = 0; k <= pieces; ++k) {
    const double time = end * static_cast<double>(k) / static_cast<double>(pieces);
    drawn.factors.push_back(evaluate_history(history, time).value);
  }
  return drawn;
}

/// A slider has no place of its own: it is drawn where the body that slides is.
DrawnJoint make_drawn_joint(const Model& model, const Joint& joint) {
  DrawnJoint drawn;
  drawn.name = joint.name;
  drawn.base = model.bodies[joint.base].name;
  drawn.action = model.bodies[joint.action].name;
  if (const auto* pin = std::get_if<RevoluteJoint>(&joint.kind)) {
    drawn.at = pin->at;
  } else {
    drawn.at = body_centre(model, joint.action);
    drawn.direction = std::get<PrismaticJoint>(joint.kind).direction;
  }
  return drawn;
}

}  // namespace

Drawing make_drawing(const Model& model) {
  Drawing drawing;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body& body = model.bodies[b];
    DrawnBody drawn;
    drawn.name = body.name;
    drawn.fixed = body.fixed;
    drawn.centre = body_centre(model, b);
    for (const Point& point : body.points) {
      drawn.point_names.push_back(point.name);
      drawn.points.push_back(point.position);
    }
    drawing.bodies.push_back(std::move(drawn));
  }
  for (const Flexure& flexure : model.flexures) {
    const AxisCurve axis(flexure.axis);
    DrawnFlexure drawn;
    drawn.name = flexure.name;
    drawn.base = model.bodies[flexure.base].name;
    drawn.action = model.bodies[flexure.action].name;
    drawn.pinned_base = flexure.pinned_base;
    drawn.pinned_action = flexure.pinned_action;
    const Section section = section_of(model, flexure);
    drawn.depth = section_properties(section).depth;
    for (int k = 0; k < station_count; ++k)
      drawn.axis.push_back(axis.position(axis.length() * k / (station_count - 1)));
    drawing.bodies[flexure.base].ends.push_back(drawn.axis.front());
    drawing.bodies[flexure.action].ends.push_back(drawn.axis.back());
    if (flexure.link) {
      drawn.depth = 0.0;  // the line round it, thin
      drawn.axis.clear();
      for (const std::size_t n : border_of(flexure.link->mesh))
        drawn.axis.push_back(flexure.link->mesh.nodes[n]);
    }
    if (section_varies(section)) {
      for (int k = 0; k < station_count; ++k) {
        const double s = axis.length() * k / (station_count - 1);
        drawn.depths.push_back(section_properties(section, s, axis.length()).depth);
      }
    }
    drawing.flexures.push_back(std::move(drawn));
  }
  for (const Spring& spring : model.springs) {
    const auto place = [&](const SpringEnd& end) {
      return end.point ? model.bodies[end.body].points[*end.point].position
                       : body_centre(model, end.body);
    };
    drawing.springs.push_back({spring.name, model.bodies[spring.base.body].name,
                               model.bodies[spring.action.body].name, place(spring.base),
                               place(spring.action), spring.torsional});
  }
  for (const Joint& joint : model.joints) drawing.joints.push_back(make_drawn_joint(model, joint));
  return drawing;
}

DrawnFields make_drawn_fields(const FieldLoads& fields) {
  DrawnFields drawn{{}, fields.gravity, fields.temperature, fields.constant};
  for (const SpreadLoad& load : fields.spread)
    drawn.spread.push_back({load.flexure, load.per_length});
  return drawn;
}

std::vector<DrawnLoad> make_drawn_loads(const Model& model, const std::vector<Load>& loads) {
  std::vector<DrawnLoad> drawn;
  for (const Load& load : loads) {
    const Body& body = model.bodies[load.body];
    const std::string on = load.point ? body.name + "." + body.points[*load.point].name : body.name;
    drawn.push_back({on, load.force, load.moment, load.follower, load.constant});
  }
  return drawn;
}

std::vector<DrawnLoad> make_drawn_loads(const Model& model, const std::vector<Load>& loads,
                                        double end) {
  std::vector<DrawnLoad> drawn = make_drawn_loads(model, loads);
  for (std::size_t i = 0; i < loads.size(); ++i)
    drawn[i].history = follow_history(loads[i].history, end);
  return drawn;
}

}  // namespace flexura

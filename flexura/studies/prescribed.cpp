#include "flexura/studies/prescribed.hpp"

#include <algorithm>

namespace flexura {
namespace {

/// Calls with every component that is prescribed and its value.
template <class Call>
void for_each_component(const Prescribed& prescribed, const Call& call) {
  using Component = SystemLayout::Prescribed::Component;
  if (prescribed.x) call(Component::x, *prescribed.x);
  if (prescribed.y) call(Component::y, *prescribed.y);
  if (prescribed.rotation) call(Component::rotation, *prescribed.rotation);
}

/// The first entry for the same body and point.
std::size_t first_of(const std::vector<Prescribed>& prescribed, std::size_t i) {
  const auto same = std::find_if(prescribed.begin(), prescribed.end(), [&](const Prescribed& p) {
    return p.body == prescribed[i].body && p.point == prescribed[i].point;
  });
  return static_cast<std::size_t>(same - prescribed.begin());
}

}  // namespace

void add_prescribed(SystemLayout& layout, const Model& model,
                    const std::vector<Prescribed>& prescribed) {
  for (const Prescribed& p : prescribed) {
    const Vec2 centre = layout.bodies[p.body].centre;
    const Vec2 at = p.point ? model.bodies[p.body].points[*p.point].position : centre;
    for_each_component(p, [&](auto component, double value) {
      layout.prescribed.push_back({p.body, at - centre, component, value});
    });
  }
}

void add_prescribed(MotionLayout& layout, const Model& model,
                    const std::vector<Prescribed>& prescribed) {
  add_prescribed(layout.mechanism, model, prescribed);
  for (const Prescribed& p : prescribed)
    for_each_component(p, [&](auto, double) { layout.prescribed.push_back(p.history); });
}

std::vector<Prescribed> with_drivers(const Model& model, std::vector<Prescribed> prescribed) {
  std::vector<Prescribed> all;
  for (const Driver& driver : model.drivers) {
    Prescribed held{driver.body, {}, 0.0, 0.0, 0.0, driver.history};
    if (driver.direction) {
      const double share = driver.amount / norm(*driver.direction);
      held.x = share * driver.direction->x;
      held.y = share * driver.direction->y;
    } else {
      held.rotation = driver.amount;
    }
    all.push_back(std::move(held));
  }
  all.insert(all.end(), prescribed.begin(), prescribed.end());
  return all;
}

std::vector<HeldPlace> held_places(const Model& model, const std::vector<Prescribed>& prescribed) {
  // as make_path_names counts them: moving bodies and their points
  std::vector<std::size_t> body_index(model.bodies.size(), 0);
  std::vector<std::size_t> first_point(model.bodies.size(), 0);
  std::size_t bodies = 0;
  std::size_t points = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].fixed) continue;
    body_index[b] = bodies++;
    first_point[b] = points;
    points += model.bodies[b].points.size();
  }
  std::vector<HeldPlace> places;
  for (std::size_t i = 0; i < prescribed.size(); ++i) {
    if (first_of(prescribed, i) != i) continue;
    const Prescribed& p = prescribed[i];
    const Body& body = model.bodies[p.body];
    HeldPlace place{body.name, body_index[p.body], {}};
    if (p.point) {
      place.name += "." + body.points[*p.point].name;
      place.point = first_point[p.body] + *p.point;
    }
    places.push_back(std::move(place));
  }
  return places;
}

std::vector<Reaction> reactions_of(const std::vector<Prescribed>& prescribed,
                                   const std::function<double(std::size_t)>& reaction_of) {
  using Component = SystemLayout::Prescribed::Component;
  std::vector<Reaction> reactions;
  std::vector<std::size_t> place(prescribed.size());
  std::size_t row = 0;
  for (std::size_t i = 0; i < prescribed.size(); ++i) {
    const std::size_t first = first_of(prescribed, i);
    if (first == i) {
      place[i] = reactions.size();
      reactions.emplace_back();
    }
    Reaction& reaction = reactions[place[first]];
    for_each_component(prescribed[i], [&](Component component, double) {
      const double value = reaction_of(row++);
      if (component == Component::x) reaction.force.x += value;
      if (component == Component::y) reaction.force.y += value;
      if (component == Component::rotation) reaction.moment += value;
    });
  }
  return reactions;
}

std::vector<Reaction> reactions_in(const System& system, const std::vector<Prescribed>& prescribed,
                                   const std::vector<double>& z) {
  return reactions_of(prescribed,
                      [&](std::size_t row) { return system.prescribed_reaction(row, z); });
}

}  // namespace flexura

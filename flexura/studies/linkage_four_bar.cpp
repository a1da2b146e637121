#include <algorithm>
#include <cmath>
#include <numbers>

#include "flexura/studies/linkage_methods.hpp"

namespace flexura {
namespace {

constexpr double same_place = 1e-9;

/// Places, as drawn, where a part is pinned to others, each once.
std::vector<Vec2> pin_places(const RigidLinkageLayout& layout, std::size_t part) {
  std::vector<Vec2> places;
  const auto add = [&](Vec2 at) {
    for (const Vec2 known : places)
      if (norm(known - at) <= same_place * layout.size) return;
    places.push_back(at);
  };
  if (part == 0 || part == layout.driven) add(layout.parts[layout.driven].centre);
  for (const auto& pin : layout.pins)
    if (pin.first == part || pin.second == part) add(pin.at);
  return places;
}

bool share_place(const RigidLinkageLayout& layout, const std::vector<Vec2>& a,
                 const std::vector<Vec2>& b) {
  for (const Vec2 p : a)
    for (const Vec2 q : b)
      if (norm(p - q) <= same_place * layout.size) return true;
  return false;
}

struct FourBar {
  std::size_t coupler = 0, follower = 0;
  double ground = 0.0, crank = 0.0, rod = 0.0, rocker = 0.0;
};

std::optional<FourBar> as_four_bar(const RigidLinkageLayout& layout) {
  std::vector<std::size_t> links;
  for (std::size_t p = 1; p < layout.parts.size(); ++p)
    if (p != layout.driven && layout.parts[p].turns) links.push_back(p);
  if (links.size() != 2 || !layout.slides.empty()) return {};
  auto ground = pin_places(layout, 0), crank = pin_places(layout, layout.driven);
  FourBar bar{links[0], links[1]};
  auto rod = pin_places(layout, bar.coupler), rocker = pin_places(layout, bar.follower);
  if (share_place(layout, ground, rod)) {
    std::swap(bar.coupler, bar.follower);
    std::swap(rod, rocker);
  }
  for (const auto* places : {&ground, &crank, &rod, &rocker})
    if (places->size() != 2) return {};
  bar.ground = norm(ground[0] - ground[1]);
  bar.crank = norm(crank[0] - crank[1]);
  bar.rod = norm(rod[0] - rod[1]);
  bar.rocker = norm(rocker[0] - rocker[1]);
  return bar;
}

/// Grashof: one link goes round if shortest and longest together are less than the other two.
std::string kind_of(const FourBar& bar) {
  std::vector<double> lengths = {bar.ground, bar.crank, bar.rod, bar.rocker};
  std::sort(lengths.begin(), lengths.end());
  const double slack = lengths[1] + lengths[2] - lengths[0] - lengths[3];
  if (std::abs(slack) < 1e-9 * lengths[3]) return "four-bar at the limit of Grashof: change points";
  if (slack < 0.0) return "four-bar, not of Grashof's kind: no link goes round";
  if (lengths[0] == bar.crank) return "crank-rocker";
  if (lengths[0] == bar.ground) return "double crank";
  if (lengths[0] == bar.rod) return "double rocker of Grashof's kind";
  return "rocker-crank: driven at the rocker";
}

}  // namespace

void describe_four_bar(const LinkageTurn& turn, LinkageResult& result) {
  const RigidLinkageLayout& layout = turn.system().rigid().layout();
  const std::optional<FourBar> bar = as_four_bar(layout);
  if (!bar) return;
  result.grashof = kind_of(*bar);
  const auto rod = pin_places(layout, bar->coupler), rocker = pin_places(layout, bar->follower);
  const auto direction = [](const std::vector<Vec2>& places) {
    return std::atan2(places[1].y - places[0].y, places[1].x - places[0].x);
  };
  const double drawn = direction(rod) - direction(rocker);
  for (RigidPosition& position : result.positions) {
    const RigidState& state = turn.state(std::abs(position.angle));
    const double angle = drawn + state.parts[bar->coupler].turn - state.parts[bar->follower].turn;
    // between lines: 0 to 90 degrees
    position.transmission_angle = std::asin(std::min(1.0, std::abs(std::sin(angle))));
  }
}

}  // namespace flexura

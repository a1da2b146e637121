#include "robustness/random_mechanism.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>

#include "flexura/geometry/axis_curve.hpp"

namespace flexura::robustness {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// The same numbers on every machine, which the distributions of the standard do not promise.
class Random {
 public:
  explicit Random(const std::function<std::uint64_t()>& source) : source_(source) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(source_() >> 11U) * 0x1p-53;
  }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  int integer(int low, int high) {
    return low + static_cast<int>(source_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool chance(double share) { return uniform(0.0, 1.0) < share; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  Vec2 direction() { return unit(uniform(-std::numbers::pi, std::numbers::pi)); }

 private:
  const std::function<std::uint64_t()>& source_;
};

struct Stuff {
  const char* name;
  double youngs_modulus;  // MPa
  double poissons_ratio;
};
constexpr Stuff stuffs[] = {{"steel", 210e3, 0.3},
                            {"aluminium", 70e3, 0.33},
                            {"titanium", 114e3, 0.32},
                            {"polypropylene", 1.4e3, 0.42},
                            {"silicone_rubber", 2.0, 0.48}};

/// Positive sweeps are counter-clockwise, with the centre to the left of the way from a to b.
ArcAxis arc_between(Vec2 a, Vec2 b, double sweep) {
  const Vec2 chord = b - a;
  const double radius = norm(chord) / (2.0 * std::sin(0.5 * std::abs(sweep)));
  const double side = sweep > 0.0 ? 1.0 : -1.0;
  const Vec2 left = (1.0 / norm(chord)) * perp(chord);
  const Vec2 centre = 0.5 * (a + b) + side * radius * std::cos(0.5 * sweep) * left;
  const Vec2 from = a - centre;
  return {centre, radius, std::atan2(from.y, from.x), sweep};
}

class Maker {
 public:
  Maker(std::uint64_t seed, const std::function<std::uint64_t()>& source) : random_(source) {
    mechanism_.seed = seed;
  }
  RandomMechanism make();

 private:
  void make_serial_chain();
  void make_parallel_stage();
  void make_closed_loops();
  void make_arch();
  std::size_t add_body(Vec2 at);
  Flexure& add_flexure(std::size_t base, std::size_t action, const AxisShape& axis);
  AxisShape random_axis(Vec2 a, Vec2 b);
  Vec2 near(Vec2 place, double reach) {
    return place + random_.uniform(0.0, reach) * size_ * random_.direction();
  }
  double bending_stiffness(const Flexure& flexure) const;
  void add_loads();
  Model& model() { return mechanism_.model; }

  Random random_;
  RandomMechanism mechanism_;
  double size_ = 1.0;
  double slenderness_ = 100.0;
  double relative_width_ = 1.0;
  bool alike_ = false;  // all flexures have the same thickness and no taper
};

std::size_t Maker::add_body(Vec2 at) {
  Body body;
  const std::size_t index = model().bodies.size();
  body.name = index == 0 ? "ground" : fmt::format("b{}", index);
  body.fixed = index == 0;
  if (!body.fixed) body.points.push_back({"P", at});
  model().bodies.push_back(std::move(body));
  return index;
}

AxisShape Maker::random_axis(Vec2 a, Vec2 b) {
  const double kind = random_.uniform(0.0, 1.0);
  if (kind < 0.55) return LineAxis{a, b};
  if (kind < 0.9)
    return arc_between(a, b, random_.sign() * random_.log_uniform(5.0, 300.0) * degree);
  const Vec2 across = random_.uniform(-0.3, 0.3) * perp(b - a);
  const Vec2 other = random_.uniform(-0.3, 0.3) * perp(b - a);
  return SplineAxis{
      {a, a + 0.33 * (b - a) + across, a + 0.67 * (b - a) + other, b}, std::nullopt, std::nullopt};
}

Flexure& Maker::add_flexure(std::size_t base, std::size_t action, const AxisShape& axis) {
  Flexure flexure;
  const std::size_t index = model().flexures.size();
  flexure.name = fmt::format("f{}", index + 1);
  flexure.base = base;
  flexure.action = action;
  flexure.axis = axis;
  flexure.section = index;
  const double spread = alike_ ? 1.0 : random_.log_uniform(0.7, 1.4);
  const double length = AxisCurve(axis).length();
  RectangleSection section;
  section.thickness = length / slenderness_ * spread;
  section.width = relative_width_ * section.thickness;
  const bool tapered = !alike_ && random_.chance(0.2);
  if (tapered) section.profile = TaperProfile{section.thickness * random_.log_uniform(0.4, 2.5)};
  const std::string name = fmt::format("s{}", index + 1);
  if (!alike_ && !tapered && random_.chance(0.1))
    model().sections.push_back({name, CircleSection{section.thickness, LeafProfile{}}, {}});
  else
    model().sections.push_back({name, section, {}});
  model().flexures.push_back(std::move(flexure));
  return model().flexures.back();
}

/// Each flexure begins somewhere on the body that the last one carries.
void Maker::make_serial_chain() {
  mechanism_.family = "serial chain";
  const int flexures = random_.integer(1, 6);
  std::size_t base = add_body({});
  Vec2 at{};
  Vec2 heading = random_.direction();
  for (int k = 0; k < flexures; ++k) {
    const Vec2 start = random_.chance(0.5) ? at : near(at, 0.5);
    heading = rotate(random_.uniform(-2.0, 2.0), heading);
    const Vec2 end = start + size_ * random_.uniform(0.5, 1.5) * heading;
    const std::size_t body = add_body(near(end, 0.5));
    add_flexure(base, body, random_axis(start, end));
    base = body;
    at = end;
  }
}

/// Legs side by side, up to the stage; perhaps a second stage hangs from the first (folded).
void Maker::make_parallel_stage() {
  mechanism_.family = "parallel stage";
  alike_ = random_.chance(0.5);
  std::size_t from = add_body({});
  const int levels = random_.integer(1, 2);
  double y = 0.0;
  for (int level = 0; level < levels; ++level) {
    const double top = y + (level == 0 ? 1.0 : random_.sign()) * size_;
    const std::size_t stage = add_body({random_.uniform(-1.0, 1.0) * size_, top});
    const int legs = random_.integer(2, 4);
    const double lean = random_.chance(0.4) ? 0.0 : random_.uniform(-0.5, 0.5);
    for (int k = 0; k < legs; ++k) {
      const double x = (k - 0.5 * (legs - 1)) * size_ * random_.uniform(0.3, 1.0);
      const double tilt = random_.chance(0.6) ? 0.0 : random_.uniform(-0.2, 0.2);
      const Vec2 foot{x, y};
      const Vec2 head{x + (tilt + lean * x / size_) * size_, top};
      const bool line = random_.chance(0.7);
      Flexure& leg =
          add_flexure(from, stage, line ? LineAxis{foot, head} : random_axis(foot, head));
      leg.pinned_base = k > 0 && random_.chance(0.1);
    }
    from = stage;
    y = top;
  }
}

/// Bodies anywhere, joined by a tree of flexures and by one to three more that close loops.
void Maker::make_closed_loops() {
  mechanism_.family = "closed loops";
  const int bodies = random_.integer(2, 5);
  std::vector<Vec2> places{{0.0, 0.0}};
  add_body({});
  const auto join = [&](std::size_t a, std::size_t b) {
    Vec2 from = near(places[a], 0.4), to = near(places[b], 0.4);
    while (norm(to - from) < 0.2 * size_) to = near(places[b], 0.6);
    return &add_flexure(a, b, random_axis(from, to));
  };
  for (int k = 1; k <= bodies; ++k) {
    const auto parent = static_cast<std::size_t>(random_.integer(0, k - 1));
    places.push_back(places[parent] + size_ * random_.uniform(0.6, 1.6) * random_.direction());
    join(parent, add_body(near(places.back(), 0.4)));
  }
  const int loops = random_.integer(1, 3);
  for (int k = 0; k < loops; ++k) {
    const auto a = static_cast<std::size_t>(random_.integer(0, bodies));
    auto b = static_cast<std::size_t>(random_.integer(0, bodies - 1));
    if (b >= a) ++b;
    join(a, b)->pinned_base = random_.chance(0.2);
  }
}

/// Two legs lean against each other: what snaps through. A third of them mirror exactly.
void Maker::make_arch() {
  mechanism_.family = "arch";
  alike_ = true;
  const bool mirrored = random_.chance(0.33);
  const std::size_t ground = add_body({});
  const double rise = size_ * random_.log_uniform(0.02, 0.8);
  const double shift = mirrored ? 0.0 : random_.uniform(-0.1, 0.1) * size_;
  const double half = random_.chance(0.5) ? 0.0 : random_.uniform(0.0, 0.3) * size_;
  const std::size_t top = add_body({shift, rise});
  const double bend = random_.chance(0.5) ? 0.0 : random_.uniform(-1.5, 1.5);
  for (const double side : {-1.0, 1.0}) {
    const Vec2 foot{side * (size_ + half), 0.0};
    const Vec2 head{side * half + shift, rise};
    AxisShape axis = LineAxis{foot, head};
    if (std::abs(bend) > 0.05) axis = arc_between(foot, head, side * bend);
    add_flexure(ground, top, axis);
  }
  const bool pinned = random_.chance(0.3);
  for (Flexure& flexure : model().flexures) flexure.pinned_base = pinned;
}

double Maker::bending_stiffness(const Flexure& flexure) const {
  const Model& model = mechanism_.model;
  const Material& material = model.materials[flexure.material];
  return material.youngs_modulus *
         section_properties(model.sections[flexure.section].shape).second_moment;
}

/// Measured by a middle flexure; three decades below what bends it visibly to far beyond that.
void Maker::add_loads() {
  const Flexure& middle = model().flexures[model().flexures.size() / 2];
  const double length = AxisCurve(middle.axis).length();
  const double moment = bending_stiffness(middle) / length;
  PathStudy study;
  const bool arch = mechanism_.family == "arch";
  const int loads = arch || random_.chance(0.7) ? 1 : 2;
  for (int k = 0; k < loads; ++k) {
    Load load;
    load.body =
        static_cast<std::size_t>(random_.integer(1, static_cast<int>(model().bodies.size()) - 1));
    if (k == 0 && random_.chance(0.6)) load.body = model().bodies.size() - 1;
    if (random_.chance(0.7)) load.point = 0;
    if (arch || random_.chance(0.8)) {
      const double size = arch ? random_.log_uniform(0.3, 300.0) : random_.log_uniform(1e-3, 100.0);
      const Vec2 along = arch && random_.chance(0.7) ? Vec2{0.0, -1.0} : random_.direction();
      load.force = size * moment / length * along;
      mechanism_.load = std::max(mechanism_.load, size);
    }
    if (norm(load.force) == 0.0 || random_.chance(0.1)) {
      const double size = random_.log_uniform(1e-3, 10.0);
      load.moment = size * moment * random_.sign();
      mechanism_.load = std::max(mechanism_.load, size);
    }
    load.follower = random_.chance(0.1);
    study.loads.push_back(load);
  }
  study.modelings.push_back({ExactSettings{}, "exact", true, true, 1e-8, {}});
  model().studies.push_back({"push", study, {}});
}

RandomMechanism Maker::make() {
  model().title = fmt::format("Random mechanism {}", mechanism_.seed);
  model().units = {"mm", "N", "s", "rad"};
  size_ = random_.log_uniform(0.1, 1000.0);
  slenderness_ = random_.log_uniform(5.0, 1e4);
  relative_width_ = random_.log_uniform(1.0, std::min(slenderness_, 100.0));
  mechanism_.slenderness = slenderness_;
  const Stuff& stuff = stuffs[random_.integer(0, std::size(stuffs) - 1)];
  Material material;
  material.name = stuff.name;
  material.youngs_modulus = stuff.youngs_modulus;
  material.poissons_ratio = stuff.poissons_ratio;
  model().materials.push_back(material);
  switch (random_.integer(0, 3)) {
    case 0:
      make_serial_chain();
      break;
    case 1:
      make_parallel_stage();
      break;
    case 2:
      make_closed_loops();
      break;
    default:
      make_arch();
  }
  add_loads();
  return std::move(mechanism_);
}

}  // namespace

RandomMechanism make_random_mechanism(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  return make_random_mechanism(seed, [&engine] { return engine(); });
}

RandomMechanism make_random_mechanism(std::uint64_t seed,
                                      const std::function<std::uint64_t()>& source) {
  return Maker(seed, source).make();
}

}  // namespace flexura::robustness

#include <fmt/format.h>

#include "flexura/model/rules.hpp"

namespace flexura {
namespace {

/// A body that hangs on one pin has no rotation of its own: it takes forces at the pin only.
class PinRules {
 public:
  PinRules(const Model& model, Mistakes& mistakes)
      : model_(model), mistakes_(mistakes), pins_(hanging_pins(model)) {}

  void check(const Load& load, const KeyPath& path) {
    if (load.body >= model_.bodies.size()) return;
    const Body& body = model_.bodies[load.body];
    if (load.point && *load.point >= body.points.size()) return;
    const std::optional<Vec2> pin = pin_of(load.body);
    if (!pin) return;
    if (load.moment != 0.0) {
      mistakes_.add(path / "moment",
                    fmt::format("body '{}' hangs on one pin: it takes no moment", body.name));
    }
    const Vec2 at = load.point ? body.points[*load.point].position : body_centre(model_, load.body);
    if (is_away(at, *pin) && load.force != Vec2{}) {
      mistakes_.add(path / "force",
                    fmt::format("body '{}' hangs on one pin at [{}, {}]: it takes no force at "
                                "[{}, {}]",
                                body.name, pin->x, pin->y, at.x, at.y));
    }
  }

  void check(const Spring& spring, const KeyPath& path) {
    for (std::size_t i = 0; i < 2; ++i) {
      const SpringEnd& end = i == 0 ? spring.base : spring.action;
      if (end.body >= model_.bodies.size() || !pin_of(end.body)) continue;
      const Body& body = model_.bodies[end.body];
      if (spring.torsional) {
        mistakes_.add(path / "torsional",
                      fmt::format("body '{}' hangs on one pin and has no rotation of its own for "
                                  "the spring to hold: pin fewer ends",
                                  body.name));
        continue;
      }
      if (end.point && *end.point >= body.points.size()) continue;
      const Vec2 at = end.point ? body.points[*end.point].position : body_centre(model_, end.body);
      if (is_away(at, *pin_of(end.body)))
        mistakes_.add(path / "between" / i,
                      fmt::format("body '{}' hangs on one pin at [{}, {}]: a spring pulls there or "
                                  "not at all",
                                  body.name, pin_of(end.body)->x, pin_of(end.body)->y));
    }
  }

  void check(const RelativeDisplacement& relative, const KeyPath& path) {
    if (relative.flexure >= model_.flexures.size() || relative.rotation == 0.0) return;
    const Flexure& flexure = model_.flexures[relative.flexure];
    for (const std::size_t body : {flexure.base, flexure.action}) {
      if (body >= model_.bodies.size() || !pin_of(body)) continue;
      mistakes_.add(path / "rotation",
                    fmt::format("body '{}' hangs on one pin: its rotation means nothing",
                                model_.bodies[body].name));
    }
  }

 private:
  static bool is_away(Vec2 at, Vec2 pin) {
    constexpr double same_place = 1e-6;
    return norm(at - pin) > same_place * (norm(at) + norm(pin));
  }

  std::optional<Vec2> pin_of(std::size_t body) const { return pins_[body]; }

  const Model& model_;
  Mistakes& mistakes_;
  std::vector<std::optional<Vec2>> pins_;
};

}  // namespace

void check_pins(const Model& model, Mistakes& mistakes) {
  PinRules rules(model, mistakes);
  const auto check_all = [&rules](const auto& entries, const KeyPath& path) {
    for (std::size_t i = 0; i < entries.size(); ++i) rules.check(entries[i], path / i);
  };
  for (const Spring& spring : model.springs) rules.check(spring, {"springs", spring.name});
  for (const Study& study : model.studies) {
    const KeyPath path = {"studies", study.name};
    if (const auto* linear = std::get_if<LinearStudy>(&study.kind)) {
      check_all(linear->loads, path / "loads");
    } else if (const auto* traced = std::get_if<PathStudy>(&study.kind)) {
      check_all(traced->loads, path / "loads");
    } else if (const auto* buckling = std::get_if<BucklingStudy>(&study.kind)) {
      check_all(buckling->loads, path / "loads");
    } else if (const auto* transient = std::get_if<TransientStudy>(&study.kind)) {
      check_all(transient->loads, path / "loads");
    } else if (const auto* response = std::get_if<ResponseStudy>(&study.kind)) {
      check_all(response->loads, path / "loads");
    } else if (const auto* linkage = std::get_if<LinkageStudy>(&study.kind)) {
      check_all(linkage->loads, path / "loads");
    } else if (const auto* inverse = std::get_if<InverseStudy>(&study.kind)) {
      check_all(inverse->relative, path / "relative");
    }
  }
}

}  // namespace flexura

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "flexura/model/rules.hpp"

namespace flexura {
namespace {

void check_amount(const Driver& driver, const KeyPath& path, Mistakes& mistakes) {
  const bool speed = std::holds_alternative<LinearHistory>(driver.history);
  const KeyPath amount = path / (speed ? "speed" : driver.direction ? "distance" : "angle");
  mistakes.require_finite(amount, driver.amount);
  if (driver.amount == 0.0)
    mistakes.add(amount, "with 0 nothing would move: `fixed = true` holds a body in its place");
  if (std::holds_alternative<StepHistory>(driver.history))
    mistakes.add(path / "history",
                 "a body cannot be elsewhere in no time, as a step would have it: a ramp takes it "
                 "there");
  check_history(driver.history, path / "history", mistakes);
}

}  // namespace

void check_drivers(const Model& model, Mistakes& mistakes) {
  std::map<std::size_t, const Driver*> driven;
  for (const Driver& driver : model.drivers) {
    const KeyPath path = {"drivers", driver.name};
    const KeyPath target = path / (driver.direction ? "move" : "turn");
    check_amount(driver, path, mistakes);
    if (driver.direction &&
        !(norm(*driver.direction) > 0.0 && std::isfinite(norm(*driver.direction))))
      mistakes.add(path / "direction", "a direction needs a length that is not zero");
    if (driver.body >= model.bodies.size()) {
      mistakes.add(target, fmt::format("there is no body number {}", driver.body));
      continue;
    }
    const Body& body = model.bodies[driver.body];
    if (body.fixed)
      mistakes.add(target, fmt::format("body '{}' is fixed: it cannot be driven", body.name));
    const auto [first, is_new] = driven.try_emplace(driver.body, &driver);
    if (!is_new)
      mistakes.add(target, fmt::format("body '{}' is driven already, by '{}': one driver says all "
                                       "of its motion",
                                       body.name, first->second->name));
  }
}

}  // namespace flexura

#include <fmt/format.h>

#include "flexura/io/read_entities.hpp"
#include "flexura/io/read_history.hpp"
#include "flexura/io/table_reader.hpp"

namespace flexura {
namespace {

void read_prismatic(Reading& reading, const Place& place, const NameIndex& bodies, Joint& joint) {
  TableReader table(reading, place, vocabulary::prismatic());
  if (const auto pair = table.require("bodies"))
    read_body_pair(reading, *pair, "two bodies [\"rail\", \"slider\"]", bodies, joint.base,
                   joint.action);
  table.require("direction");
  joint.kind = PrismaticJoint{table.vector("direction", dimensions::number, {})};
}

/// What turns has an angle, what moves a distance along a direction; either has a speed instead.
void refuse_others(Reading& reading, TableReader& table, bool moves) {
  const auto refuse = [&](const char* key, const char* why) {
    if (table.has(key)) reading.report_key(table.path(), key, table.position(key), why);
  };
  if (moves) {
    refuse("angle", "what moves along a direction has a distance, not an angle");
  } else {
    refuse("distance", "what turns has an angle, not a distance");
    refuse("direction", "what turns has no direction; `move` has one");
  }
}

void read_motion(Reading& reading, TableReader& table, Driver& driver, bool moves) {
  const std::string amount = moves ? "distance" : "angle";
  const std::vector<std::string> ways = {"speed", amount};
  refuse_others(reading, table, moves);
  if (table.has(moves ? "angle" : "distance")) {
    driver.amount = 1.0;
    return;
  }
  const auto way = table.exactly_one_of(ways);
  if (!way) return;
  const auto history = table.find("history");
  if (*way == "speed") {
    driver.amount =
        table.required_quantity("speed", moves ? dimensions::speed : dimensions::angular_speed);
    if (history)
      reading.report_key(table.path(), "history", table.position("history"),
                         fmt::format("a speed goes on and on: what has a history has {} {} instead",
                                     moves ? "a" : "an", amount));
    return;
  }
  driver.amount = table.required_quantity(amount, moves ? dimensions::length : dimensions::angle);
  driver.history = StepHistory{};
  if (history) {
    driver.history = read_history(reading, *history).value_or(StepHistory{});
  } else if (!reading.has_mistake(table.path("history"))) {
    reading.report_key(table.path(), "history", table.position(amount),
                       fmt::format("{} {} needs a history that says when: history = {{ ramp = "
                                   "[0, 1] }}, say",
                                   moves ? "a" : "an", amount));
  }
}

Driver read_driver(Reading& reading, const NamedPlace& entry, const NameIndex& bodies) {
  static const std::vector<std::string> kinds = {"turn", "move"};
  TableReader table(reading, entry.place, vocabulary::driver());
  Driver driver;
  driver.name = entry.name;
  driver.source = entry.position;
  driver.body = NameIndex::none;
  const auto kind = table.exactly_one_of(kinds);
  if (!kind) return driver;
  const Place target = *table.find(*kind);
  if (const auto name = read_text(reading, target))
    driver.body = bodies.resolve(reading, target, *name);
  const bool moves = *kind == "move";
  if (moves) {
    table.require("direction");
    driver.direction = table.vector("direction", dimensions::number, {});
  }
  read_motion(reading, table, driver, moves);
  return driver;
}

}  // namespace

std::vector<Joint> read_joints(Reading& reading, const Place& place, const NameIndex& bodies) {
  static const std::vector<std::string> kinds = {"revolute", "prismatic"};
  std::vector<Joint> joints;
  for (const NamedPlace& entry : read_names(reading, place)) {
    TableReader table(reading, entry.place, vocabulary::joint());
    Joint joint{entry.name, NameIndex::none, NameIndex::none, RevoluteJoint{}, entry.position};
    const auto kind = table.exactly_one_of(kinds);
    if (kind == "revolute") {
      read_body_pair(reading, *table.find("revolute"), "two bodies [\"crank\", \"rod\"]", bodies,
                     joint.base, joint.action);
      table.require("at");
      joint.kind = RevoluteJoint{table.vector("at", dimensions::length, {})};
    } else if (kind == "prismatic") {
      read_prismatic(reading, *table.find("prismatic"), bodies, joint);
      if (table.has("at"))
        reading.report_key(table.path(), "at", table.position("at"),
                           "a prismatic joint slides along its direction, wherever it is: only a "
                           "revolute one has a place");
    }
    joints.push_back(std::move(joint));
  }
  return joints;
}

std::vector<Driver> read_drivers(Reading& reading, const Place& place, const NameIndex& bodies) {
  std::vector<Driver> drivers;
  for (const NamedPlace& entry : read_names(reading, place))
    drivers.push_back(read_driver(reading, entry, bodies));
  return drivers;
}

}  // namespace flexura

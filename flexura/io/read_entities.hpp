#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "flexura/io/reading.hpp"
#include "flexura/model/model.hpp"

namespace flexura {

std::vector<Material> read_materials(Reading& reading, const Place& place);
std::vector<NamedSection> read_sections(Reading& reading, const Place& place);
std::vector<Body> read_bodies(Reading& reading, const Place& place);

/// The names of one kind of entity, for those who refer to them.
class NameIndex {
 public:
  /// `complete` is false where the table itself is missing or unreadable: unknown names then go
  /// unreported, as that one mistake explains them all.
  /// Messages read "unknown <what> 'name'<where>".
  NameIndex(std::string what, bool complete, std::string where = "")
      : what_(std::move(what)), complete_(complete), where_(std::move(where)) {}

  template <typename Entities>
  static NameIndex of(std::string what, bool complete, const Entities& entities) {
    NameIndex index(std::move(what), complete);
    for (const auto& entity : entities) index.add(entity.name);
    return index;
  }

  void add(const std::string& name) {
    index_.emplace(name, names_.size());
    names_.push_back(name);
  }

  /// What an unknown name leads to: beyond every list.
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// Index of the name; `none`, after a report with the nearest name, if there is no such.
  std::size_t resolve(Reading& reading, const Place& place, const std::string& name) const;

 private:
  std::string what_;
  bool complete_;
  std::string where_;
  std::vector<std::string> names_;
  std::unordered_map<std::string, std::size_t> index_;
};

/// What a model's references lead to.
struct Names {
  NameIndex materials;
  NameIndex sections;
  NameIndex bodies;
};

/// Two names of bodies in a list, into indices; `what` is expected, in words.
void read_body_pair(Reading& reading, const Place& place, const std::string& what,
                    const NameIndex& bodies, std::size_t& first, std::size_t& second);

std::vector<Joint> read_joints(Reading& reading, const Place& place, const NameIndex& bodies);
std::vector<Driver> read_drivers(Reading& reading, const Place& place, const NameIndex& bodies);

std::vector<Flexure> read_flexures(Reading& reading, const Place& place, const Names& names);
AxisShape read_axis(Reading& reading, const Place& place);

}  // namespace flexura

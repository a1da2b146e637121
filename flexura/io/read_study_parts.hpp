#pragma once

#include <string>
#include <vector>

#include "flexura/io/read_studies.hpp"
#include "flexura/io/table_reader.hpp"

// What studies of several kinds have in common.
namespace flexura {

/// What a load may be in a study of a kind: with a history where there is time, along flexures
/// where there are fields to put those in.
struct LoadPlace {
  std::string kind;
  bool in_time = false;
  FieldLoads* fields = nullptr;
  bool over_angle = false;  ///< histories are over the angle of a drive, under the key `angle`
};

std::vector<Load> read_loads(Reading& reading, const Place& place, const StudyNames& names,
                             const LoadPlace& where);

std::vector<Prescribed> read_prescribe(Reading& reading, const Place& place,
                                       const StudyNames& names, const LoadPlace& where);

/// `gravity` and `temperature`.
void read_surroundings(TableReader& table, FieldLoads& fields);

/// Index of the label among the modelings, or that of their default.
std::size_t read_reference(Reading& reading, const TableReader& table,
                           const std::vector<ModelingSettings>& modelings, bool complete);

/// `modelings` and `reference`, of whichever study has them.
template <typename StudyKind>
void read_modelings_of(Reading& reading, TableReader& table, StudyKind& study) {
  const auto modelings = table.require("modelings");
  if (modelings) study.modelings = read_modelings(reading, *modelings);
  study.reference =
      read_reference(reading, table, study.modelings, modelings && modelings->node->array());
}

/// The studies of motion.
ModesStudy read_modes(Reading& reading, const Place& place, const StudyNames& names);
TransientStudy read_transient(Reading& reading, const Place& place, const StudyNames& names);
ResponseStudy read_response(Reading& reading, const Place& place, const StudyNames& names);
LinkageStudy read_linkage(Reading& reading, const Place& place, const StudyNames& names);

DampingSettings read_damping(Reading& reading, const Place& place);

}  // namespace flexura

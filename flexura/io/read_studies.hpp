#pragma once

#include <vector>

#include "flexura/io/read_entities.hpp"
#include "flexura/io/reading.hpp"
#include "flexura/model/model.hpp"

namespace flexura {

/// What the studies refer to.
struct StudyNames {
  const std::vector<Body>& bodies;
  NameIndex body_names;
  NameIndex flexure_names;
  NameIndex driver_names{"driver", true};
  NameIndex study_names{"study", true};  ///< filled in where studies are read
};

std::vector<Study> read_studies(Reading& reading, const Place& place, StudyNames names);

std::vector<Spring> read_springs(Reading& reading, const Place& place, const StudyNames& names);

/// A study's list of modelings, each a name or a table of settings.
std::vector<ModelingSettings> read_modelings(Reading& reading, const Place& place);

/// One of them.
ModelingSettings read_modeling(Reading& reading, const Place& place);

/// The modeling the others are compared with where the file names none: continuum, else the first
/// exact one, else the last named.
std::size_t default_reference(const std::vector<ModelingSettings>& modelings);

/// The value of a prbm modeling's `parameters`: the name of a set, or a table.
PrbmSettings read_prbm_parameters(Reading& reading, const Place& place);

}  // namespace flexura

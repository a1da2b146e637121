#pragma once

#include <string>
#include <vector>

namespace flexura {

/// The keys of one kind of table: those understood, and those of the format that this version
/// does not support yet. The schema and the documentation name the same ones.
struct Vocabulary {
  std::vector<std::string> keys;
  std::vector<std::string> planned;
};

namespace vocabulary {

const Vocabulary& model();
const Vocabulary& units();
const Vocabulary& material();
const Vocabulary& section();
const Vocabulary& rectangle();
const Vocabulary& circle();
const Vocabulary& profile();
const Vocabulary& taper();
const Vocabulary& round();
const Vocabulary& elliptic();
const Vocabulary& no_keys();
const Vocabulary& general();
const Vocabulary& body();
const Vocabulary& flexure();
const Vocabulary& mesh();
const Vocabulary& outline();
const Vocabulary& outline_side();
const Vocabulary& outline_hole();
const Vocabulary& spring();
const Vocabulary& joint();
const Vocabulary& prismatic();
const Vocabulary& driver();
const Vocabulary& history();
const Vocabulary& half_sine();
const Vocabulary& harmonic();
const Vocabulary& axis();
const Vocabulary& arc();
const Vocabulary& linear_study();
const Vocabulary& path_study();
const Vocabulary& stage();
const Vocabulary& buckling_study();
const Vocabulary& inverse_study();
const Vocabulary& modes_study();
const Vocabulary& transient_study();
const Vocabulary& response_study();
const Vocabulary& linkage_study();
const Vocabulary& speed_harmonic();
const Vocabulary& speeds();
const Vocabulary& midha();
/// A state of a study, for `from` and `about`; modes know a curve along it as well.
const Vocabulary& study_state();
const Vocabulary& modes_about();
const Vocabulary& frequencies();
const Vocabulary& damping();
const Vocabulary& load();
const Vocabulary& until();
const Vocabulary& branch();
const Vocabulary& controls();
const Vocabulary& prescribed();
const Vocabulary& relative();
/// Of a modeling's table: `modeling` is "linear", "scmbm", "prbm", "exact" or "beam".
const Vocabulary& modeling(const std::string& modeling);
const Vocabulary& prbm_parameters();

/// Words, not keys: kinds of study, modelings, prbm parameter sets, beam theories, methods of time
/// integration, solvers for modes, kinds of mass.
const Vocabulary& study_kinds();
const Vocabulary& modelings();
const Vocabulary& parameter_sets();
const Vocabulary& planes();
const Vocabulary& laws();
const Vocabulary& face_ends();
const Vocabulary& theories();
const Vocabulary& methods();
const Vocabulary& mode_solvers();
const Vocabulary& linkage_methods();
const Vocabulary& geometric_stiffness();
const Vocabulary& continuities();
const Vocabulary& masses();

}  // namespace vocabulary
}  // namespace flexura

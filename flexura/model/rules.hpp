#pragma once

#include <string>
#include <utility>
#include <vector>

#include "flexura/model/validation.hpp"

// The rules behind find_mistakes, a function for each group. All of them cope with any Model.
namespace flexura {

inline constexpr int largest_mode_count = 1000;  ///< that a study may ask for

/// Collects broken rules.
class Mistakes {
 public:
  void add(const KeyPath& path, std::string message) {
    list_.push_back({path, std::move(message), false});
  }
  void add_independent(const KeyPath& path, std::string message) {
    list_.push_back({path, std::move(message), true});
  }

  void require_finite(const KeyPath& path, double value);
  void require_finite(const KeyPath& path, Vec2 value);
  void require_positive(const KeyPath& path, double value);
  void require_not_negative(const KeyPath& path, double value);
  void require_between(const KeyPath& path, int value, int least, int greatest);

  std::vector<Mistake> take() && { return std::move(list_); }

 private:
  std::vector<Mistake> list_;
};

/// Names are unique and can stand in file names and column heads.
void check_names(const Model& model, Mistakes& mistakes);

/// Materials, sections, bodies and flexures, each for itself.
void check_entities(const Model& model, Mistakes& mistakes);

/// Profiles of sections, alone and on the flexures that have them.
void check_profiles(const Model& model, Mistakes& mistakes);
/// Whether an axis is one, so that a curve can be made of it.
bool has_length(const AxisShape& axis);

/// Stiffness and ends of springs.
void check_springs(const Model& model, Mistakes& mistakes);

/// Joints, each for itself.
void check_joints(const Model& model, Mistakes& mistakes);

/// Joints that hold again what others hold.
void check_redundant_joints(const Model& model, Mistakes& mistakes);

/// Drivers, each for itself.
void check_drivers(const Model& model, Mistakes& mistakes);

/// Something moves, and everything that moves is held, or flies.
void check_connections(const Model& model, Mistakes& mistakes);

/// A history for itself.
void check_history(const TimeHistory& history, const KeyPath& path, Mistakes& mistakes);

/// A history over a study from time 0 on; `study` is what messages call it.
void check_history_during(const TimeHistory& history, double duration, const std::string& study,
                          const KeyPath& path, Mistakes& mistakes);

/// Targets and sizes of a study's loads, `path` being that of the study.
void check_loads(const Model& model, const std::vector<Load>& loads, const KeyPath& path,
                 Mistakes& mistakes);

/// Prescribed displacements, of bodies that can take them.
void check_prescribed(const Model& model, const std::vector<Prescribed>& all, const KeyPath& path,
                      Mistakes& mistakes);

/// What acts along flexures needs their expansion, if they are heated, and modelings that carry it.
void check_fields(const Model& model, const FieldLoads& fields,
                  const std::vector<ModelingSettings>& modelings, const KeyPath& path,
                  Mistakes& mistakes);

/// Loads, steps, modelings and references of every study.
void check_studies(const Model& model, Mistakes& mistakes);

/// The studies of motion.
void check_motion(const Model& model, const ModesStudy& study, const KeyPath& path,
                  Mistakes& mistakes);
void check_motion(const Model& model, const TransientStudy& study, const KeyPath& path,
                  Mistakes& mistakes);
void check_motion(const Model& model, const ResponseStudy& study, const KeyPath& path,
                  Mistakes& mistakes);
void check_motion(const Model& model, const LinkageStudy& study, const KeyPath& path,
                  Mistakes& mistakes);

/// Materials without the density that studies of motion need, and transient studies that start
/// from one another.
void check_motion_of_all(const Model& model, Mistakes& mistakes);

/// Prescribed relative displacements that miss a body or reach it twice.
void check_forests(const Model& model, Mistakes& mistakes);

/// Loads and rotations that a body on one pin cannot take.
void check_pins(const Model& model, Mistakes& mistakes);

/// A study's modelings, `path` being that of the study.
void check_modelings(const Model& model, const std::vector<ModelingSettings>& modelings,
                     std::size_t reference, const KeyPath& path, Mistakes& mistakes);

/// Howell's parameters follow the load; `where` they cannot, they need a load_ratio.
void check_load_ratios(const std::vector<ModelingSettings>& modelings, const std::string& where,
                       const KeyPath& path, Mistakes& mistakes);

/// A label or study name: it becomes part of a file name.
bool is_file_word(const std::string& word);

}  // namespace flexura

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "flexura/model/validation.hpp"

// The rules behind find_mistakes, a function for each group. All of them cope with any Model.
namespace flexura {

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

/// Stiffness and ends of springs.
void check_springs(const Model& model, Mistakes& mistakes);

/// Something moves, and everything that moves is held.
void check_connections(const Model& model, Mistakes& mistakes);

/// Loads, steps, modelings and references of every study.
void check_studies(const Model& model, Mistakes& mistakes);

/// Prescribed relative displacements that miss a body or reach it twice.
void check_forests(const Model& model, Mistakes& mistakes);

/// Loads and rotations that a body on one pin cannot take.
void check_pins(const Model& model, Mistakes& mistakes);

/// A study's modelings, `path` being that of their list.
void check_modelings(const Model& model, const std::vector<ModelingSettings>& modelings,
                     std::size_t reference, const KeyPath& path, Mistakes& mistakes);

/// A label or study name: it becomes part of a file name.
bool is_file_word(const std::string& word);

}  // namespace flexura

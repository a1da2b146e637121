#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "flexura/geometry/axis_curve.hpp"
#include "flexura/model/rules.hpp"

namespace flexura {
namespace {

enum class Shape { straight, symmetric, any };

/// Constant or alike from both ends: what equal springs need.
bool is_symmetric(const Section& section) {
  const std::vector<const Profile*> profiles = varying_profiles(section);
  return std::all_of(profiles.begin(), profiles.end(), [](const Profile* profile) {
    return std::holds_alternative<NotchProfile>(*profile) ||
           std::holds_alternative<FilletProfile>(*profile);
  });
}

bool varies(const Model& model, const Flexure& flexure) {
  return flexure.section < model.sections.size() &&
         section_varies(model.sections[flexure.section].shape);
}

bool has_shape(const Model& model, const Flexure& flexure, Shape shape) {
  if (flexure.section < model.sections.size()) {
    const Section& section = model.sections[flexure.section].shape;
    if (shape == Shape::symmetric ? !is_symmetric(section) : section_varies(section)) return false;
  }
  if (shape == Shape::straight) return std::holds_alternative<LineAxis>(flexure.axis);
  return shape == Shape::any || !std::holds_alternative<SplineAxis>(flexure.axis);
}

/// The names of the flexures that do not have the shape, few enough to read; empty if all do.
std::string flexures_unlike(const Model& model, Shape shape) {
  constexpr int most_named = 4;
  std::string names;
  int count = 0;
  for (const Flexure& flexure : model.flexures) {
    if (has_shape(model, flexure, shape)) continue;
    if (++count > most_named) continue;
    names += (names.empty() ? "'" : ", '") + flexure.name + "'";
    if (varies(model, flexure)) names += " (its section varies)";
  }
  if (count > most_named) names += fmt::format(" and {} more", count - most_named);
  return names;
}

struct PrbmRules {
  const Model& model;
  const KeyPath modeling;
  Mistakes& mistakes;

  void operator()(const PrbmEqualSprings&) const { need(Shape::symmetric, "equal_springs"); }
  void operator()(const PrbmSu&) const { need(Shape::straight, "su"); }
  void operator()(const PrbmHowell& howell) const {
    need(Shape::straight, "howell");
    if (howell.load_ratio) {
      mistakes.require_finite(modeling / "parameters" / "load_ratio", *howell.load_ratio);
    }
  }

  void operator()(const PrbmSegments& segments) const {
    need(Shape::straight, "lengths");
    const KeyPath lengths = modeling / "parameters" / "lengths";
    if (segments.lengths.size() != segments.stiffness.size() + 1) {
      mistakes.add(lengths, fmt::format("must be one more than the springs in stiffness, {}; "
                                        "there are {}",
                                        segments.stiffness.size(), segments.lengths.size()));
    }
    for (std::size_t i = 0; i < segments.lengths.size(); ++i) {
      mistakes.require_not_negative(lengths / i, segments.lengths[i]);
    }
    const double sum = std::accumulate(segments.lengths.begin(), segments.lengths.end(), 0.0);
    constexpr double rounding = 1e-9;
    if (!(std::abs(sum - 1.0) <= rounding)) {
      mistakes.add(lengths,
                   fmt::format("must sum to 1, the length of the flexure; the sum is {}", sum));
    }
    check_stiffness(segments.stiffness);
  }

  void operator()(const PrbmJoints& joints) const {
    need(Shape::any, "joints");
    const KeyPath path = modeling / "parameters" / "joints";
    if (joints.joints.size() != joints.stiffness.size()) {
      mistakes.add(path, fmt::format("there are {} joints but {} springs in stiffness",
                                     joints.joints.size(), joints.stiffness.size()));
    }
    for (std::size_t i = 0; i < joints.joints.size(); ++i) {
      mistakes.require_finite(path / i, joints.joints[i]);
    }
    check_stiffness(joints.stiffness);
  }

 private:
  static const char* words(Shape shape) {
    if (shape == Shape::symmetric) return "symmetric";
    return shape == Shape::straight ? "straight" : "uniform";
  }

  void need(Shape shape, const char* parameters) const {
    const std::string names = flexures_unlike(model, shape);
    if (names.empty()) return;
    mistakes.add(modeling, fmt::format("modeling prbm with parameters '{}' is for {} flexures; "
                                       "this model has {}",
                                       parameters, words(shape), names));
  }

  void check_stiffness(const std::vector<double>& stiffness) const {
    const KeyPath path = modeling / "parameters" / "stiffness";
    if (stiffness.empty()) mistakes.add(path, "needs a spring");
    for (std::size_t i = 0; i < stiffness.size(); ++i) {
      mistakes.require_positive(path / i, stiffness[i]);
    }
  }
};

struct ModelingRules {
  const Model& model;
  const KeyPath path;
  Mistakes& mistakes;
  bool axial;

  void operator()(const LinearSettings&) const {}
  void operator()(const ScmbmSettings&) const {}
  void operator()(const PrbmSettings& prbm) const {
    std::visit(PrbmRules{model, path, mistakes}, prbm.parameters);
  }
  void operator()(const ExactSettings& exact) const {
    if (exact.modes) mistakes.require_between(path / "modes", *exact.modes, 2, 32);
  }
  void operator()(const BeamSettings& beam) const {
    mistakes.require_between(path / "elements", beam.elements, 1, 100000);
    mistakes.require_between(path / "order", beam.order, 1, 8);
    const std::string varying = flexures_unlike(model, Shape::any);
    if (beam.theory != BeamSettings::Theory::exact && !varying.empty())
      mistakes.add(path, fmt::format("these elements need constant sections, exact ones do not; "
                                     "this model has {}",
                                     varying));
    if (beam.theory != BeamSettings::Theory::exact && !axial)
      mistakes.add(path / "axial", "these elements need axial strain; exact ones do without");
    const std::string curved = flexures_unlike(model, Shape::straight);
    if (beam.theory == BeamSettings::Theory::printed && varying.empty() && !curved.empty())
      mistakes.add(path / "theory",
                   fmt::format("the printed elements are for straight flexures; this model has {}; "
                               "'von_karman' bends any",
                               curved));
  }
  void operator()(const BcmSettings& bcm) const {
    mistakes.require_between(path / "elements", bcm.elements, 1, 200);
    const std::string curved = flexures_unlike(model, Shape::straight);
    if (curved.empty()) return;
    mistakes.add(
        path,
        fmt::format("modeling bcm is for straight flexures of constant section; this model has {}",
                    curved));
  }
  void operator()(const ContinuumSettings& continuum) const {
    const auto between = [&](const char* key, const std::optional<int>& value, int least,
                             int most) {
      if (value) mistakes.require_between(path / key, *value, least, most);
    };
    between("elements", continuum.elements, 2, 100000);
    between("across", continuum.across, 1, 200);
    between("order", continuum.order, 1, 8);
    between("order_across", continuum.order_across, 1, 8);
    refuse_giants(continuum);
    for (const Flexure& flexure : model.flexures) {
      refuse_folds(flexure);
      if (flexure.section < model.sections.size() &&
          std::holds_alternative<CircleSection>(model.sections[flexure.section].shape))
        mistakes.add(path, fmt::format("modeling continuum is for sections of a thickness and a "
                                       "width; '{}' is round",
                                       flexure.name));
    }
  }

  /// What would only end when the memory does.
  void refuse_giants(const ContinuumSettings& continuum) const {
    constexpr double most = 3e6;
    const int order = continuum.order.value_or(2);
    const double columns = static_cast<double>(order) * continuum.elements.value_or(50);
    const double rows =
        static_cast<double>(continuum.order_across.value_or(order)) * continuum.across.value_or(1);
    const double unknowns = 2.0 * columns * (rows + 1.0);
    if (unknowns > most)
      mistakes.add(path, fmt::format("every flexure would have {:.0f} million unknowns; {:.0f} "
                                     "million are the most",
                                     1e-6 * unknowns, 1e-6 * most));
  }

  /// Where the axis turns within half the thickness, the inner side of the outline runs back.
  void refuse_folds(const Flexure& flexure) const {
    constexpr int looks = 200;
    if (flexure.section >= model.sections.size() || !has_length(flexure.axis)) return;
    const AxisCurve axis(flexure.axis);
    for (int k = 0; k <= looks; ++k) {
      const double s = axis.length() * k / looks;
      const SectionProperties section =
          section_properties(model.sections[flexure.section].shape, s, axis.length());
      const double half = 0.5 * std::sqrt(12.0 * section.second_moment / section.area);
      if (!(std::abs(axis.curvature(s)) * half >= 1.0)) continue;
      const Vec2 at = axis.position(s);
      mistakes.add(path,
                   fmt::format("the mesh of '{}' folds over: at ({:.4g}, {:.4g}) the axis "
                               "turns with radius {:.4g}, half the thickness is {:.4g}",
                               flexure.name, at.x, at.y, 1.0 / std::abs(axis.curvature(s)), half));
      return;
    }
  }
};

/// Whether the modeling takes links of any shape: as they are, or by their compliance.
bool takes_links(const ModelingSettings& settings) {
  return std::holds_alternative<ContinuumSettings>(settings.kind) ||
         std::holds_alternative<LinearSettings>(settings.kind) ||
         std::holds_alternative<ScmbmSettings>(settings.kind);
}

/// Whether all flexures are what the modeling takes; says which is not.
bool check_links(const Model& model, const ModelingSettings& settings, const KeyPath& path,
                 Mistakes& mistakes) {
  if (takes_links(settings)) return true;
  for (const Flexure& flexure : model.flexures) {
    if (!flexure.link) continue;
    mistakes.add(path, fmt::format("modeling {} is for strips, with an axis and a section; flexure "
                                   "'{}' is a mesh, which continuum takes, and linear and scmbm by "
                                   "its compliance",
                                   modeling_name(settings), flexure.name));
    return false;
  }
  return true;
}

}  // namespace

void check_load_ratios(const std::vector<ModelingSettings>& modelings, const std::string& where,
                       const KeyPath& path, Mistakes& mistakes) {
  for (std::size_t m = 0; m < modelings.size(); ++m) {
    const auto* prbm = std::get_if<PrbmSettings>(&modelings[m].kind);
    const auto* howell = prbm ? std::get_if<PrbmHowell>(&prbm->parameters) : nullptr;
    if (howell && !howell->load_ratio)
      mistakes.add(
          path / "modelings" / m,
          fmt::format("Howell's parameters follow the load: {} they need a load_ratio", where));
  }
}

void check_modelings(const Model& model, const std::vector<ModelingSettings>& modelings,
                     std::size_t reference, const KeyPath& path, Mistakes& mistakes) {
  if (modelings.empty()) mistakes.add(path / "modelings", "at least one modeling is needed");
  std::map<std::string, std::size_t> labels;
  for (std::size_t i = 0; i < modelings.size(); ++i) {
    const ModelingSettings& settings = modelings[i];
    const KeyPath entry = path / "modelings" / i;
    if (check_links(model, settings, entry, mistakes))
      std::visit(ModelingRules{model, entry, mistakes, settings.axial}, settings.kind);
    if (!(settings.tolerance > 0.0 && settings.tolerance < 1.0)) {
      mistakes.add(entry / "tolerance",
                   fmt::format("must lie between 0 and 1, is {}", settings.tolerance));
    }
    if (!is_file_word(settings.label)) {
      mistakes.add(entry / "label",
                   fmt::format("the label '{}' becomes a file name: only letters, digits, _ and -",
                               settings.label));
    }
    const auto [first, is_new] = labels.try_emplace(settings.label, i);
    if (!is_new) {
      mistakes.add(entry / "label",
                   fmt::format("the label '{}' is taken by the modeling before it (number {}); "
                               "give one of them a label of its own",
                               settings.label, first->second + 1));
    }
  }
  if (!modelings.empty() && reference >= modelings.size()) {
    mistakes.add(path / "reference", fmt::format("there is no modeling number {}", reference));
  }
}

}  // namespace flexura

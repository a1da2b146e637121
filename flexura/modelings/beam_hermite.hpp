#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "flexura/core/jet2.hpp"
#include "flexura/modelings/beam_common.hpp"

namespace flexura {

/// Von Karman elements in frames that follow the chord between their nodes: quintic deflection,
/// and the axial displacement that makes the axial force constant, so that nothing locks. The
/// linear theory is the quadratic expansion of the same energy about the drawn state.
class HermiteBeamPort final : public TwoPort {
 public:
  HermiteBeamPort(const FlexureProperties& flexure, BeamSettings settings);

  std::size_t internal_size() const override { return 1 + elements() * (shears() ? 5 : 4); }
  std::size_t scratch_size() const override {
    return internal_size() * (4 + 2 * (width() + 1) + 1 + (feels_surroundings() ? 12 : 0));
  }
  bool feels_surroundings() const override { return flexure_.field.acts(); }
  TipResponse linearize_in(const Surroundings& surroundings, const Eigen::Vector3d& load,
                           const double* internal, double* scratch,
                           FieldResponse& field) const override;
  TipResponse linearize(const Eigen::Vector3d& load, const double* internal,
                        double* scratch) const override;
  Eigen::MatrixXd hessian(const Eigen::Vector3d& load, const double* internal) const override;
  std::vector<SectionState> sections(const Eigen::Vector3d& load,
                                     std::span<const double> internal) const override {
    return sections_in({}, load, internal);
  }
  std::vector<SectionState> sections_in(const Surroundings& surroundings,
                                        const Eigen::Vector3d& load,
                                        std::span<const double> internal) const override;
  std::shared_ptr<const TwoPort> refined() const override {
    BeamSettings finer = settings_;
    finer.elements *= 2;
    return std::make_shared<HermiteBeamPort>(flexure_, finer);
  }
  void prolong(std::span<const double> internal, std::span<double> refined) const override;
  double error_ratio() const override { return 4.0 / 3.0; }

  /// The unknowns of an element: per node displacement x, y, rotation, curvature; shear strain.
  static constexpr std::size_t element_unknowns = 9;
  using Unknowns = Jet2<element_unknowns>;
  /// Places of an element's unknowns in the flexure's; -1 for those of the clamped end.
  std::array<int, element_unknowns> places(std::size_t element) const;
  /// Half bandwidth of the energy's Hessian.
  std::size_t width() const { return shears() ? 8 : 7; }
  /// As MotionPort::weights.
  std::vector<double> weights() const;
  /// As LagrangeBeamPort::assemble.
  double assemble(const double* y, double* columns, double* band, double heat) const;
  /// Puts the load on the tip into `columns`; where the tip is.
  Eigen::Vector3d add_tip_load(const Eigen::Vector3d& load, const double* y, double* columns) const;
  bool is_linear() const { return settings_.theory == BeamSettings::Theory::linear; }
  /// What the unknowns make of an element; by the linear theory, taken at the drawn state.
  struct ElementJets;
  ElementJets element_jets(std::size_t element, const double* y) const;
  /// Where the axis is at x in [0, 1] of an element, and the direction of the section there (or of
  /// the axis), by the element's unknowns.
  using PlaceJets = std::array<Unknowns, 2>;
  PlaceJets place_at(const ElementJets& element, double x) const;
  PlaceJets direction_at(const ElementJets& element, double x, bool along_axis) const;
  /// Sections with the forces of their strains.
  std::vector<SectionState> strained_sections(std::span<const double> internal) const;

 private:
  static constexpr int gauss_points = 6;
  /// What the energy of an element depends on: elongation of its chord, slopes of its two end
  /// sections against the chord, second derivatives of the deflection there, shear strain.
  enum Deformation { elongation, slope_a, slope_b, bend_a, bend_b, shear, deformations };

  /// An element as drawn.
  struct Element {
    Vec2 start;
    Vec2 direction;
    double length = 0.0;
    std::array<double, 2> slopes;  // of the axis against the chord
    std::array<double, 2> bends;   // second derivative of its graph
    double tangent_angle = 0.0;    // of the chord
  };
  struct Energy {
    double value = 0.0;
    std::array<double, element_unknowns> gradient{};
    std::array<std::array<double, element_unknowns>, element_unknowns> hessian{};
    std::array<double, element_unknowns> by_heat{};  ///< of the gradient
    double heat = 0.0;                               ///< derivative of the value by it
  };
  /// Dead load times place, summed over an element, and its derivative by the turn of the base.
  struct DeadWork {
    Unknowns now;
    Unknowns by_turn;
  };
  /// What the nodes' unknowns make of an element.
  using Deformed = std::array<Unknowns, deformations>;

  std::size_t elements() const { return static_cast<std::size_t>(settings_.elements); }
  bool shears() const { return flexure_.shear_compliance > 0.0; }
  std::array<double, element_unknowns> gather(std::size_t element, const double* y) const;
  Deformed deform(const Element& element, const std::array<double, element_unknowns>& v) const;
  Energy energy(std::size_t element, const double* y, double heat) const;
  DeadWork dead_work(std::size_t element, const double* y, double turn) const;
  void add_dead(std::size_t element, const double* y, const Surroundings& surroundings,
                double* work, double* coupling, FieldResponse& field) const;
  void add_heat(std::size_t element, const double* y, double load_factor, double* coupling,
                FieldResponse& field) const;
  void add_element(std::size_t element, const double* y, double heat, double* residual,
                   double* band, double& energy) const;
  double assemble(const double* y, double* scratch, double heat = 0.0) const {
    return assemble(y, scratch, scratch + 4 * internal_size(), heat);
  }
  /// Slope and second derivative of an element's deflection at x, of the deformed state and drawn.
  struct Graph {
    double slope = 0.0;
    double bend = 0.0;
    double drawn_slope = 0.0;
    double drawn_bend = 0.0;
  };
  Graph graph_at(std::size_t element, double x, const Deformed& deformed) const;
  Deformed deformed_values(std::size_t element, const double* y) const;
  PlaceJets to_first_order(PlaceJets jets, const std::array<double, element_unknowns>& v) const;
  double axial_force(std::size_t element, const double* y) const;
  double bending_moment(std::size_t element, double x, const double* y) const;
  DisplacementElements assembled() const {
    return {internal_size(), width(), internal_size() - 4, length_, chord_};
  }
  /// Where the point `drawn` of the true axis has gone that lies at x in [0, 1] of an element: the
  /// element carries along what its own axis lacks to it.
  Pose axis_pose(std::size_t element, double x, Vec2 drawn, const double* y) const;
  /// Pose of the section at x in [0, 1] of an element, rotation since the start.
  Pose section_pose(std::size_t element, double x, const double* y) const;

  FlexureProperties flexure_;
  BeamSettings settings_;
  std::vector<Element> elements_;
  std::vector<double> rest_;  // unknowns of the drawn state
  double length_ = 0.0;
  Vec2 chord_;
};

struct HermiteBeamPort::ElementJets {
  std::size_t index = 0;
  std::array<double, element_unknowns> at{};  ///< the unknowns
  Deformed deformed;
  Unknowns x, y;           ///< displacement of the near node
  Unknowns along, beside;  ///< vector to the far node
  Unknowns shortness;      ///< inverse of its length
};

}  // namespace flexura

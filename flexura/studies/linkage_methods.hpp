#pragma once

#include <functional>
#include <vector>

#include "flexura/studies/linkage_record.hpp"
#include "flexura/studies/linkage_turn.hpp"

namespace flexura {

/// States at all positions of a turn by one method, and what it took.
struct LinkageSolution {
  Termination termination;
  std::vector<ElasticState> states;
  std::vector<std::complex<double>> multipliers;
  int iterations = 0;
  std::string counted;
  std::string remark;
};

/// Derivatives by time, of what has them by the angle.
ElasticState by_time(const DriveRate& drive, double speed, const OscillationState& state);

/// Stages of Radau's rule in every interval of the periodic solution.
inline constexpr int periodic_stages = 6;
/// Of a linkage that is solved to see what its elements leave out: 1e-5 of the strains.
inline constexpr int estimate_stages = 3;

LinkageSolution solve_quasi_static(const LinkageTurn& turn, double speed);
/// The periodic boundary-value problem.
LinkageSolution solve_periodic(LinkageTurn& turn, const LinkageStudy& study, double speed,
                               int stages = periodic_stages);
/// From rest in the quasi-static position, turn by turn, until nothing changes any more or the turn
/// has come that the study wants to see.
LinkageSolution solve_transient(LinkageTurn& turn, const LinkageStudy& study, double speed,
                                const std::function<bool(double)>& keep_going);
/// Midha's intervals of frozen coefficients (Midha, Erdman and Frohrib 1979; Turcic and Midha
/// 1984).
LinkageSolution solve_midha(LinkageTurn& turn, const LinkageStudy& study, double speed);

/// The periodic motion of the same linkage as a mechanism of geometrically exact flexures, without
/// the assumption of small displacements, at the study's speed and at lower ones; beside each, how
/// far kineto-elastodynamics with the same damping is off. Modal damping, which belongs to a
/// position, is replaced by one proportional to the elastic forces, of the same share in the first
/// mode.
struct NonlinearComparison {
  LinkageMotion motion;
  std::vector<std::string> notes;
};
NonlinearComparison compare_with_nonlinear(const Model& model, const LinkageStudy& study,
                                           const LinkageTurn& turn, const LinkageResult& result,
                                           const std::function<bool(double)>& keep_going);

/// Natural frequencies at all positions, ascending, and followed by their shapes.
void find_frequencies(const LinkageTurn& turn, const LinkageStudy& study, double speed,
                      LinkageResult& result);

/// Multipliers of Floquet and largest strains over the study's speeds.
std::vector<SpeedState> sweep_speeds(const Model& model, const LinkageStudy& study,
                                     const std::function<bool(double)>& keep_going);

/// What kind of four-bar it is, and its transmission angle at every position; nothing for others.
void describe_four_bar(const LinkageTurn& turn, LinkageResult& result);

}  // namespace flexura

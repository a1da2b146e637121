#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "flexura/core/termination.hpp"
#include "flexura/results/path_result.hpp"

namespace flexura {

/// Energies and momenta of the whole mechanism at a time. `work` is what loads, gravity and
/// whatever is prescribed have done since the start, `dissipated` what dampers and damping have
/// taken; what remains of kinetic + strain - work + dissipated - (its value at the start) is the
/// error of the time integration.
struct EnergyBalance {
  double kinetic = 0.0;
  double strain = 0.0;
  double work = 0.0;
  double dissipated = 0.0;
  double error = 0.0;
  Vec2 momentum;
  double angular_momentum = 0.0;  ///< about the origin
  double drift = 0.0;  ///< largest gap of a joint, a flexure's end or what is prescribed (length)
};

/// The mechanism at a time; the state's load factor means nothing here.
struct MotionState {
  double time = 0.0;
  PathState state;
  EnergyBalance energy;
};

/// One modeling's motion.
struct ModelingMotion {
  std::string label;
  std::string modeling;
  Termination termination;
  std::vector<MotionState> states;                  ///< at the output times, the start included
  std::vector<std::vector<MemberStation>> members;  ///< per flexure, at the last state
  int unknowns = 0;
  int steps = 0;
  int rejected = 0;    ///< steps that were taken again, shorter
  int iterations = 0;  ///< of Newton's method, in all
  double smallest_step = 0.0;
  double largest_step = 0.0;
  double seconds = 0.0;
  /// Largest error of the energy balance over the run, relative to the largest energy met.
  double energy_error = 0.0;
  /// Largest distance of any named point, over time, from where a finer run takes it, relative to
  /// its largest displacement.
  std::optional<double> error_estimate;
  /// The same norm, against the study's reference modeling; absent for the reference itself.
  std::optional<double> difference;
};

/// All modelings of one study of kind `transient`. Names are those of a PathResult.
struct MotionResult {
  std::vector<std::string> bodies;
  std::vector<std::string> points;
  std::vector<std::string> flexures;
  std::vector<std::optional<double>> strengths;
  std::vector<HeldPlace> held;
  std::string method;   ///< as the study says it: "radau", "generalized_alpha", ..
  std::string damping;  ///< a sentence
  std::vector<ModelingMotion> modelings;
  std::size_t reference = 0;
};

/// Complex amplitudes u of displacements u e^{i w t} under loads that go as cos w t: the modulus is
/// the amplitude, the argument the phase by which the motion runs ahead of the loads.
struct ResponseState {
  double angular_frequency = 0.0;
  std::vector<std::complex<double>> amplitudes;  ///< in the order of ResponseResult::places
};

struct ModelingResponse {
  std::string label;
  std::string modeling;
  Termination termination;
  std::vector<ResponseState> states;
  int unknowns = 0;
  double seconds = 0.0;
  std::optional<double> error_estimate;  ///< of amplitudes, relative to the largest of their place
  std::optional<double> difference;
};

/// All modelings of one study of kind `response`. Places are displacements, "body.x", "body.y",
/// "body.rotation" of every moving body and "body.point.x", "body.point.y" of its named points.
struct ResponseResult {
  std::vector<std::string> places;
  std::string damping;
  std::vector<ModelingResponse> modelings;
  std::size_t reference = 0;
};

}  // namespace flexura

// Valid mechanisms built from the bytes of the input, solved by studies `linear` and `path`. Every
// number of a result must be finite, and every stop have a reason.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "flexura/io/write_csv.hpp"
#include "flexura/model/validation.hpp"
#include "flexura/studies/run_studies.hpp"
#include "fuzz/target.hpp"
#include "robustness/random_mechanism.hpp"

namespace {

using namespace flexura;

void check(const PathResult& paths) {
  for (const ModelingPath& path : paths.modelings) {
    fuzz::expect(path.termination.converged() || !path.termination.reason.empty());
    for (const PathState& state : path.states)
      for (const Pose& body : state.bodies)
        fuzz::expect(std::isfinite(body.position.x) && std::isfinite(body.position.y) &&
                     std::isfinite(body.rotation));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::size_t at = 0;
  const auto bits = [&]() -> std::uint64_t {
    std::uint64_t number = 0x5bd1e995U * (at + 1);  // what follows the end of the input
    if (at < size) std::memcpy(&number, data + at, std::min<std::size_t>(8, size - at));
    at += 8;
    return number;
  };
  robustness::RandomMechanism mechanism = robustness::make_random_mechanism(0, bits);
  auto& study = std::get<PathStudy>(mechanism.model.studies.front().kind);
  study.steps = 2;
  study.arc_length = bits() % 4 == 0;
  study.until.steps = 20;
  study.modelings.push_back({LinearSettings{}, "linear", true, true, 1e-8, {}});
  study.modelings.push_back({BeamSettings{2, 3, {}}, "beam", true, true, 1e-8, {}});
  mechanism.model.studies.push_back({"ellipses", LinearStudy{study.loads, true, true}, {}});
  if (!validate_model(mechanism.model).empty()) return 0;  // coinciding places, say
  const Result result = run_studies(mechanism.model, {{}, {}, 1, {}});
  for (const StudyResult& done : result.studies)
    if (const auto* paths = std::get_if<PathResult>(&done.content)) check(*paths);
  return 0;
}

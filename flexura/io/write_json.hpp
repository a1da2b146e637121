#pragma once

#include <string>

#include "flexura/results/result.hpp"

namespace flexura {

/// summary.json: what every study and modeling cost, how far it is off, and how it ended.
std::string make_summary_json(const Result& result);

/// ellipse.json of a study `linear`. Numbers of both files read back to the same double; one
/// that is absent or not finite is null.
std::string make_ellipse_json(const Result& result, const StudyResult& study,
                              const LinearResult& linear);

/// Text of `<label>.stiffness.json`: the condensed stiffness of chosen bodies.
std::string make_stiffness_json(const Result& result, const PathResult& path,
                                const ModelingPath& modeling);

}  // namespace flexura

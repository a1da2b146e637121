#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flexura/pictures/frame.hpp"

namespace flexura::pictures {

/// What one modeling of a study does, as a picture shows it.
struct Course {
  std::vector<std::string> points;  ///< whose way is drawn: "body.point" or "body"
  std::vector<HeldPlace> held;      ///< in the order of Frame::reactions
  std::vector<Frame> frames;        ///< as they follow each other, evenly in time; at least one
  std::vector<Frame> ghosts;        ///< what is drawn pale below: one, or one per frame
  std::vector<Frame> way;           ///< finer than the frames, for the ways of points
  std::vector<std::size_t> shafts;  ///< bodies that turn while their centres stay in place
  bool returns = false;             ///< comes back the same way
  double seconds = 4.0;             ///< that it takes, there and back
  std::string caption;              ///< what is to be known to read the picture; may be empty
};

struct CourseRequest {
  std::string modeling;                ///< its label
  std::size_t mode = 0;                ///< of studies with modes, from 0
  std::optional<double> exaggeration;  ///< of displacements; default: as the eye needs it
};

/// Precondition: the study has that modeling and that mode, if it has modes at all; one that
/// stopped may have none. Studies of kind `linear` and `response` have no course.
Course make_course(const Result& result, const StudyResult& study, const CourseRequest& request);

/// Places in a linkage: its links rigid, and with their deflections exaggerated.
Course make_linkage_course(const Result& result, const LinkageResult& linkage,
                           const CourseRequest& request);

/// The largest side of the box round the mechanism as drawn; 1 for a point.
double extent(const Drawing& drawing);

/// 1, 2 or 5 times a power of ten, at most `value` > 0.
double round_factor(double value);

/// "×20", or nothing for 1.
std::string factor_words(const std::string& what, double factor);

}  // namespace flexura::pictures

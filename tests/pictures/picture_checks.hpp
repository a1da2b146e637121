#pragma once

#include <string>
#include <vector>

namespace flexura::pictures {

/// What a browser would stumble over: elements that are not closed, values that are no numbers,
/// animated data whose letters change. Sentences; none of a sound picture.
std::vector<std::string> picture_faults(const std::string& svg);

std::size_t count_of(const std::string& text, const std::string& part);

}  // namespace flexura::pictures

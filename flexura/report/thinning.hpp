#pragma once

#include <cstddef>
#include <vector>

namespace flexura {

/// Which of `count` states are kept: every n-th and the last, with the smallest n for which
/// `longest` states in place of `count` would leave no more than `most` (and the last). Runs of one
/// study, of which some end early, are thinned alike so that they stay comparable.
std::vector<std::size_t> thinned(std::size_t count, std::size_t longest, std::size_t most);

}  // namespace flexura

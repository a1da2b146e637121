#pragma once

#include "flexura/results/result.hpp"

namespace flexura::sample {

/// A result with everything a page, a table or a file has to cope with: an arc chain under two
/// path studies (one of them stopped early after an event), an inverse study and a linear one,
/// and a title that would break a careless page.
Result make_sample_result();

}  // namespace flexura::sample

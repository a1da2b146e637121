#pragma once

#include "flexura/results/ellipse.hpp"
#include "tests/report/sample_chain.hpp"

namespace flexura::sample {

/// Compliances, ellipses and poles of the chain's springs: sums over the joints, the definition
/// of an elastic weight and its second moments.
LinearResult make_linear_result(const Chain& chain, const TipLoad& load);

}  // namespace flexura::sample

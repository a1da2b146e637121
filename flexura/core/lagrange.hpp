#pragma once

#include <vector>

namespace flexura {

/// Values at x of the Lagrange polynomials through `places`.
std::vector<double> lagrange_values(const std::vector<double>& places, double x);

/// Their derivatives at x.
std::vector<double> lagrange_slopes(const std::vector<double>& places, double x);

}  // namespace flexura

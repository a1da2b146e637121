#pragma once

#include <span>
#include <vector>

namespace flexura {

/// Nodes in [-1, 1], ascending, and weights.
struct QuadratureRule {
  std::vector<double> nodes;
  std::vector<double> weights;
};

/// The n-point Gauss-Legendre rule, exact to degree 2n - 1; n >= 1. Made once per n, safe to call
/// from any thread.
const QuadratureRule& gauss_legendre(int n);

/// The n-point Gauss-Lobatto rule (both ends are nodes), exact to degree 2n - 3; n >= 2.
const QuadratureRule& gauss_lobatto(int n);

/// Integrals of the polynomials through the nodes of the n-point Gauss-Legendre rule, from the
/// start of an interval to each of its nodes, in units of its length: n x n, entry (node,
/// polynomial).
const std::vector<double>& gauss_partial_integrals(int n);

/// Legendre polynomials P_0(x) .. P_{n-1}(x) into `values` (n = its size).
void evaluate_legendre(double x, std::span<double> values);

/// Integrals of P_0 .. P_{n-1} from -1 to x: (P_{i+1} - P_{i-1})/(2i + 1), with P_{-1} = -1.
void integrate_legendre(double x, std::span<double> values);

}  // namespace flexura

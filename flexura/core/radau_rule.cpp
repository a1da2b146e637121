#include "flexura/core/radau_rule.hpp"

#include <cmath>
#include <vector>

#include "flexura/core/quadrature.hpp"

namespace flexura {
namespace {

/// P_s - P_(s-1) at x in [-1, 1]: its roots are the nodes.
double node_polynomial(int stages, double x) {
  std::vector<double> p(static_cast<std::size_t>(stages) + 1);
  evaluate_legendre(x, p);
  return p[static_cast<std::size_t>(stages)] - p[static_cast<std::size_t>(stages) - 1];
}

/// By bisection, between -1 and 1: at 1 lies the last.
std::vector<double> inner_roots(int stages) {
  std::vector<double> roots;
  constexpr int samples = 2000;
  double before = -1.0;
  for (int k = 1; k < samples; ++k) {
    const double next = -std::cos(3.141592653589793 * k / samples);
    double low = before, high = next;
    before = next;
    if (node_polynomial(stages, low) * node_polynomial(stages, high) > 0.0) continue;
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      (node_polynomial(stages, low) * node_polynomial(stages, middle) <= 0.0 ? high : low) = middle;
    }
    roots.push_back(0.5 * (low + high));
  }
  return roots;
}

}  // namespace

RadauRule radau_rule(int stages) {
  std::vector<double> roots = inner_roots(stages);
  roots.push_back(1.0);
  const Eigen::Index s = stages;
  RadauRule rule{Eigen::VectorXd(s), Eigen::MatrixXd(s, s)};
  // in Legendre's basis: integrals of the polynomials, and the values that fix coefficients
  Eigen::MatrixXd values(s, s), integrals(s, s);
  std::vector<double> row(static_cast<std::size_t>(stages));
  for (Eigen::Index i = 0; i < s; ++i) {
    const double x = roots[static_cast<std::size_t>(i)];
    rule.nodes[i] = 0.5 * (1.0 + x);
    evaluate_legendre(x, row);
    for (Eigen::Index j = 0; j < s; ++j) values(i, j) = row[static_cast<std::size_t>(j)];
    integrate_legendre(x, row);
    for (Eigen::Index j = 0; j < s; ++j) integrals(i, j) = 0.5 * row[static_cast<std::size_t>(j)];
  }
  rule.integrals = integrals * values.inverse();
  return rule;
}

}  // namespace flexura

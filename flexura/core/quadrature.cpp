#include "flexura/core/quadrature.hpp"

#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>

namespace flexura {
namespace {

struct LegendreAt {
  double value;
  double slope;
};

/// P_n and its derivative, |x| < 1.
LegendreAt legendre_at(int n, double x) {
  double previous = 1.0;
  double current = n == 0 ? 1.0 : x;
  for (int i = 1; i < n; ++i) {
    const double next = ((2 * i + 1) * x * current - i * previous) / (i + 1);
    previous = current;
    current = next;
  }
  if (n == 0) return {1.0, 0.0};
  return {current, n * (x * current - previous) / (x * x - 1.0)};
}

QuadratureRule make_gauss_legendre(int n) {
  QuadratureRule rule{std::vector<double>(static_cast<std::size_t>(n)),
                      std::vector<double>(static_cast<std::size_t>(n))};
  for (int i = 0; i < (n + 1) / 2; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    for (int iteration = 0; iteration < 10; ++iteration) {
      const LegendreAt p = legendre_at(n, x);
      const double step = p.value / p.slope;
      x -= step;
      if (std::abs(step) < 1e-16) break;
    }
    if (2 * i + 1 == n) x = 0.0;
    const double slope = legendre_at(n, x).slope;
    const double weight = 2.0 / ((1.0 - x * x) * slope * slope);
    const auto low = static_cast<std::size_t>(i);
    const auto high = static_cast<std::size_t>(n - 1 - i);
    rule.nodes[low] = x;
    rule.nodes[high] = -x;
    rule.weights[low] = rule.weights[high] = weight;
  }
  return rule;
}

/// Interior nodes are the zeros of P'_{n-1}; weights 2/(n (n-1) P_{n-1}^2).
QuadratureRule make_gauss_lobatto(int n) {
  QuadratureRule rule{std::vector<double>(static_cast<std::size_t>(n)),
                      std::vector<double>(static_cast<std::size_t>(n))};
  const int degree = n - 1;
  const double scale = 2.0 / (n * degree);
  rule.nodes.front() = -1.0;
  rule.nodes.back() = 1.0;
  rule.weights.front() = rule.weights.back() = scale;
  for (int i = 1; i < degree; ++i) {
    double x = -std::cos(std::numbers::pi * i / degree);
    for (int iteration = 0; iteration < 20; ++iteration) {
      const LegendreAt p = legendre_at(degree, x);
      // (1 - x^2) P'' = 2 x P' - degree (degree + 1) P
      const double curvature =
          (2.0 * x * p.slope - degree * (degree + 1) * p.value) / (1.0 - x * x);
      const double step = p.slope / curvature;
      x -= step;
      if (std::abs(step) < 1e-16) break;
    }
    const double value = legendre_at(degree, x).value;
    rule.nodes[static_cast<std::size_t>(i)] = x;
    rule.weights[static_cast<std::size_t>(i)] = scale / (value * value);
  }
  return rule;
}

/// The polynomial through the h-th node alone is sum_i (i + 1/2) w_h P_i(x_h) P_i(x), i < n, as the
/// rule is exact for products of these.
std::vector<double> make_partial_integrals(int n) {
  const QuadratureRule& rule = gauss_legendre(n);
  const auto count = static_cast<std::size_t>(n);
  std::vector<double> partial(count * count, 0.0), values(count), integrals(count);
  for (std::size_t g = 0; g < count; ++g) {
    integrate_legendre(rule.nodes[g], integrals);
    for (std::size_t h = 0; h < count; ++h) {
      evaluate_legendre(rule.nodes[h], values);
      for (std::size_t i = 0; i < count; ++i)
        partial[g * count + h] +=
            0.5 * (static_cast<double>(i) + 0.5) * rule.weights[h] * values[i] * integrals[i];
    }
  }
  return partial;
}

/// Tables are asked for again and again, and making one is not free.
template <class Make, class Table>
const Table& cached(int n, Make make, std::mutex& mutex,
                    std::map<int, std::unique_ptr<Table>>& tables) {
  const std::scoped_lock lock(mutex);
  auto& table = tables[n];
  if (!table) table = std::make_unique<Table>(make(n));
  return *table;
}

}  // namespace

const QuadratureRule& gauss_legendre(int n) {
  static std::mutex mutex;
  static std::map<int, std::unique_ptr<QuadratureRule>> rules;
  return cached(n, make_gauss_legendre, mutex, rules);
}

const QuadratureRule& gauss_lobatto(int n) {
  static std::mutex mutex;
  static std::map<int, std::unique_ptr<QuadratureRule>> rules;
  return cached(n, make_gauss_lobatto, mutex, rules);
}

const std::vector<double>& gauss_partial_integrals(int n) {
  static std::mutex mutex;
  static std::map<int, std::unique_ptr<std::vector<double>>> tables;
  return cached(n, make_partial_integrals, mutex, tables);
}

void evaluate_legendre(double x, std::span<double> values) {
  double previous = 0.0;
  double current = 1.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = current;
    const auto k = static_cast<double>(i);
    const double next = ((2.0 * k + 1.0) * x * current - k * previous) / (k + 1.0);
    previous = current;
    current = next;
  }
}

void integrate_legendre(double x, std::span<double> values) {
  double before = -1.0;  // P_{i-1}, with the convention P_{-1} = -1
  double current = 1.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto k = static_cast<double>(i);
    const double next = ((2.0 * k + 1.0) * x * current - (i == 0 ? 0.0 : k * before)) / (k + 1.0);
    values[i] = (next - before) / (2.0 * k + 1.0);
    before = current;
    current = next;
  }
}

}  // namespace flexura

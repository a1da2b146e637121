#include "flexura/core/envelope_ldlt.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "flexura/core/by_processor.hpp"
#include "flexura/core/ldlt.hpp"

namespace flexura {
namespace {

constexpr std::size_t block = 4;

/// row[k] -= sum over c of l[c] v[c][k], from `begin` to `end` (not included).
FLEXURA_BY_PROCESSOR void subtract_four(double* __restrict row, const double* __restrict l,
                                        const double* __restrict v0, const double* __restrict v1,
                                        const double* __restrict v2, const double* __restrict v3,
                                        std::size_t begin, std::size_t end) {
  const double l0 = l[0], l1 = l[1], l2 = l[2], l3 = l[3];
  for (std::size_t k = begin; k < end; ++k)
    row[k] -= l0 * v0[k] + l1 * v1[k] + l2 * v2[k] + l3 * v3[k];
}

FLEXURA_BY_PROCESSOR double product(const double* __restrict a, const double* __restrict b,
                                    std::size_t n) {
  double sum[4] = {};
  std::size_t k = 0;
  for (; k + 4 <= n; k += 4)
    for (std::size_t c = 0; c < 4; ++c) sum[c] += a[k + c] * b[k + c];
  for (; k < n; ++k) sum[0] += a[k] * b[k];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

FLEXURA_BY_PROCESSOR void subtract(double* __restrict x, double factor, const double* __restrict a,
                                   std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) x[k] -= factor * a[k];
}

/// The columns of a block, undivided, below it.
struct Panel {
  std::array<std::vector<double>, block> columns;
  explicit Panel(std::size_t rows) {
    for (auto& column : columns) column.assign(rows, 0.0);
  }
};

/// Eliminates columns j .. j + count from rows j .. end, without the update of what follows.
bool factor_panel(const Envelope& shape, double* a, std::size_t j, std::size_t count,
                  std::size_t end, Panel& panel, EnvelopePivots& found) {
  for (std::size_t c = 0; c < count; ++c) {
    double largest = 0.0;
    for (std::size_t i = j + c; i < end; ++i) {
      double* row = shape.row(a, i);
      double value = row[j + c];
      for (std::size_t b = 0; b < c; ++b) value -= row[j + b] * panel.columns[b][j + c - j];
      panel.columns[c][i - j] = value;
      if (i > j + c) largest = std::max(largest, std::abs(value));
    }
    const double pivot = panel.columns[c][c];
    shape.row(a, j + c)[j + c] = pivot;
    if (!(std::abs(pivot) > weak_pivot * largest) || pivot == 0.0) return false;
    if (pivot < 0.0) ++found.negative;
    const double inverse = 1.0 / pivot;
    for (std::size_t i = j + c + 1; i < end; ++i)
      shape.row(a, i)[j + c] = panel.columns[c][i - j] * inverse;
  }
  return true;
}

}  // namespace

Envelope::Envelope(std::vector<std::size_t> last) : last_(std::move(last)) {
  const std::size_t n = last_.size();
  first_.assign(n, 0);
  std::size_t width = 0;
  std::size_t column = 0;
  for (std::size_t i = 0; i < n; ++i) {
    while (last_[column] < i) ++column;
    first_[i] = column;
    width = std::max(width, i - column);
  }
  // columns of a block reach as far as the last of them does
  stride_ = std::min(n, width + block) + 1;
}

EnvelopePivots eliminate(const Envelope& shape, std::size_t pivots, double* a) {
  EnvelopePivots found;
  std::size_t tallest = 0;
  for (std::size_t j = 0; j < pivots; ++j) tallest = std::max(tallest, shape.last(j) - j);
  Panel panel(tallest + block + 1);
  for (std::size_t j = 0; j < pivots; j += block) {
    const std::size_t count = std::min(block, pivots - j);
    const std::size_t end = shape.last(j + count - 1) + 1;
    if (!factor_panel(shape, a, j, count, end, panel, found)) {
      found.weak = true;
      return found;
    }
    for (std::size_t c = count; c < block; ++c)
      std::fill(panel.columns[c].begin(), panel.columns[c].end(), 0.0);
    for (std::size_t i = j + count; i < end; ++i) {
      double* row = shape.row(a, i);
      const double l[block] = {row[j], count > 1 ? row[j + 1] : 0.0, count > 2 ? row[j + 2] : 0.0,
                               count > 3 ? row[j + 3] : 0.0};
      subtract_four(row + j, l, panel.columns[0].data(), panel.columns[1].data(),
                    panel.columns[2].data(), panel.columns[3].data(), count, i - j + 1);
    }
  }
  return found;
}

void substitute_forward(const Envelope& shape, std::size_t pivots, const double* a,
                        std::size_t columns, std::size_t start, double* b) {
  for (std::size_t i = start + 1; i < shape.size(); ++i) {
    const std::size_t begin = std::max(start, shape.first(i));
    const std::size_t end = std::min(i, pivots);
    if (begin >= end) continue;
    const double* row = shape.row(a, i);
    if (columns == 1) {
      b[i] -= product(row + begin, b + begin, end - begin);
      continue;
    }
    double sum[4] = {};
    for (std::size_t j = begin; j < end; ++j)
      for (std::size_t c = 0; c < 4; ++c) sum[c] += row[j] * b[4 * j + c];
    for (std::size_t c = 0; c < 4; ++c) b[4 * i + c] -= sum[c];
  }
}

void substitute_back(const Envelope& shape, std::size_t pivots, const double* a, double* x) {
  for (std::size_t i = shape.size(); i-- > 0;) {
    const std::size_t begin = shape.first(i);
    const std::size_t end = std::min(i, pivots);
    if (begin < end) subtract(x + begin, x[i], shape.row(a, i) + begin, end - begin);
  }
}

}  // namespace flexura

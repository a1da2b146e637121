#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flexura {

/// What an L D L^T factorization found; negative pivots count negative eigenvalues (Sylvester).
/// `weak` where a pivot was too small to divide by, with nothing after it factorized.
struct LdltInertia {
  int negative = 0;
  bool weak = false;
};

/// L D L^T without pivoting of a symmetric band matrix, in place. Entry (i, j), j <= i, is at
/// a[i * row_stride + shift + j], defined for i - j <= width; L replaces what is below the diagonal
/// and D the diagonal. A dense matrix is one of width n - 1.
///
/// For matrices that are positive definite, or indefinite by a few well separated directions:
/// Newton corrects the rounding of a small pivot, and a vanishing one is reported. Right-looking,
/// so that the inner loop runs along rows.
struct BandLayout {
  std::size_t n = 0;
  std::size_t width = 0;
  std::size_t row_stride = 0;
  std::size_t shift = 0;  ///< of the column index in row 0; decreases by `slide` from row to row
  std::size_t slide = 0;

  double* row(double* a, std::size_t i) const { return a + i * row_stride + shift - i * slide; }
  const double* row(const double* a, std::size_t i) const {
    return a + i * row_stride + shift - i * slide;
  }
};

/// n x n, row-major.
inline BandLayout dense_layout(std::size_t n) { return {n, n == 0 ? 0 : n - 1, n, 0, 0}; }
/// Rows of width + 1 entries, the diagonal last; entries left of the matrix are unused.
inline BandLayout band_layout(std::size_t n, std::size_t width) {
  return {n, width, width + 1, width, 1};
}

/// Of the largest entry below it. Newton corrects the digits that a pivot above this loses.
inline constexpr double weak_pivot = 1e-8;

/// `column` is scratch for n doubles.
inline LdltInertia factorize_ldlt(double* __restrict a, const BandLayout& layout,
                                  double* __restrict column) {
  LdltInertia inertia;
  for (std::size_t j = 0; j < layout.n; ++j) {
    const double pivot = layout.row(a, j)[j];
    double largest = 0.0;
    if (pivot < 0.0) ++inertia.negative;
    const std::size_t end = std::min(layout.n, j + layout.width + 1);
    for (std::size_t i = j + 1; i < end; ++i) {
      column[i] = layout.row(a, i)[j];
      largest = std::max(largest, std::abs(column[i]));
    }
    if (!(std::abs(pivot) > weak_pivot * largest) || pivot == 0.0) {
      inertia.weak = true;
      return inertia;
    }
    const double inverse = 1.0 / pivot;
    for (std::size_t i = j + 1; i < end; ++i) {
      double* __restrict row = layout.row(a, i);
      const double l = column[i] * inverse;
      for (std::size_t k = j + 1; k <= i; ++k) row[k] -= l * column[k];
      row[j] = l;
    }
  }
  return inertia;
}

/// Solves in place for `Columns` right-hand sides, interleaved: b[i * Columns + c].
template <std::size_t Columns>
void solve_ldlt(const double* __restrict a, const BandLayout& layout, double* __restrict b) {
  const std::size_t n = layout.n;
  for (std::size_t j = 0; j < n; ++j) {
    const double* row = layout.row(a, j);
    double* bj = b + j * Columns;
    for (std::size_t k = j > layout.width ? j - layout.width : 0; k < j; ++k)
      for (std::size_t c = 0; c < Columns; ++c) bj[c] -= row[k] * b[k * Columns + c];
  }
  for (std::size_t j = 0; j < n; ++j) {
    const double inverse = 1.0 / layout.row(a, j)[j];
    for (std::size_t c = 0; c < Columns; ++c) b[j * Columns + c] *= inverse;
  }
  for (std::size_t j = n; j-- > 0;) {
    const double* row = layout.row(a, j);
    const double* bj = b + j * Columns;
    for (std::size_t k = j > layout.width ? j - layout.width : 0; k < j; ++k)
      for (std::size_t c = 0; c < Columns; ++c) b[k * Columns + c] -= row[k] * bj[c];
  }
}

}  // namespace flexura

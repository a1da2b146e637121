#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

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

  template <class T>
  T* row(T* a, std::size_t i) const {
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

/// `column` is scratch for n numbers. Of a complex (symmetric, not Hermitian) matrix nothing is
/// counted.
template <class T>
LdltInertia factorize_ldlt(T* __restrict a, const BandLayout& layout, T* __restrict column) {
  LdltInertia inertia;
  for (std::size_t j = 0; j < layout.n; ++j) {
    const T pivot = layout.row(a, j)[j];
    double largest = 0.0;
    if constexpr (std::is_same_v<T, double>)
      if (pivot < 0.0) ++inertia.negative;
    const std::size_t end = std::min(layout.n, j + layout.width + 1);
    for (std::size_t i = j + 1; i < end; ++i) {
      column[i] = layout.row(a, i)[j];
      largest = std::max(largest, std::abs(column[i]));
    }
    if (!(std::abs(pivot) > weak_pivot * largest) || pivot == T{}) {
      inertia.weak = true;
      return inertia;
    }
    const T inverse = 1.0 / pivot;
    for (std::size_t i = j + 1; i < end; ++i) {
      if (column[i] == T{}) continue;  // a band is wide for its widest rows
      T* __restrict row = layout.row(a, i);
      const T l = column[i] * inverse;
      for (std::size_t k = j + 1; k <= i; ++k) row[k] -= l * column[k];
      row[j] = l;
    }
  }
  return inertia;
}

/// y = A x for a symmetric matrix whose lower triangle is laid out so.
inline void multiply_symmetric(const double* __restrict a, const BandLayout& layout,
                               const double* __restrict x, double* __restrict y) {
  for (std::size_t i = 0; i < layout.n; ++i) {
    const double* row = layout.row(a, i);
    const double own = x[i];
    double sum = row[i] * own;
    for (std::size_t j = i > layout.width ? i - layout.width : 0; j < i; ++j) {
      if (row[j] == 0.0) continue;
      sum += row[j] * x[j];
      y[j] += row[j] * own;
    }
    y[i] = sum;
  }
}

/// Solves in place for `Columns` right-hand sides, interleaved: b[i * Columns + c].
template <std::size_t Columns, class T>
void solve_ldlt(const T* __restrict a, const BandLayout& layout, T* __restrict b) {
  const std::size_t n = layout.n;
  for (std::size_t j = 0; j < n; ++j) {
    const T* row = layout.row(a, j);
    T* bj = b + j * Columns;
    for (std::size_t k = j > layout.width ? j - layout.width : 0; k < j; ++k)
      for (std::size_t c = 0; c < Columns; ++c) bj[c] -= row[k] * b[k * Columns + c];
  }
  for (std::size_t j = 0; j < n; ++j) {
    const T inverse = 1.0 / layout.row(a, j)[j];
    for (std::size_t c = 0; c < Columns; ++c) b[j * Columns + c] *= inverse;
  }
  for (std::size_t j = n; j-- > 0;) {
    const T* row = layout.row(a, j);
    const T* bj = b + j * Columns;
    for (std::size_t k = j > layout.width ? j - layout.width : 0; k < j; ++k)
      for (std::size_t c = 0; c < Columns; ++c) b[k * Columns + c] -= row[k] * bj[c];
  }
}

}  // namespace flexura

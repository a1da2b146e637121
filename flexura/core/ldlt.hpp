#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flexura {

/// What an L D L^T factorization found; negative pivots count negative eigenvalues (Sylvester).
struct LdltInertia {
  int negative = 0;
  bool singular = false;
};

/// L D L^T without pivoting of a small dense symmetric matrix: n x n, row-major, lower triangle,
/// overwritten by L below the diagonal and D on it. For matrices that are positive definite, or
/// indefinite by a few well separated directions: Newton corrects the rounding of a small pivot,
/// and a vanishing one is reported.
inline LdltInertia factorize_ldlt(double* a, std::size_t n) {
  LdltInertia inertia;
  for (std::size_t j = 0; j < n; ++j) {
    double* row_j = a + j * n;
    // Row j of the lower triangle still holds A; rows above hold L and D.
    double largest = std::abs(row_j[j]);
    for (std::size_t k = 0; k < j; ++k) {
      double v = row_j[k];
      const double* row_k = a + k * n;
      for (std::size_t i = 0; i < k; ++i) v -= row_j[i] * row_k[i];
      row_j[k] = v;  // L_jk D_k, divided below
    }
    double pivot = row_j[j];
    for (std::size_t k = 0; k < j; ++k) {
      const double l = row_j[k] / a[k * n + k];
      pivot -= l * row_j[k];
      largest = std::fmax(largest, std::abs(l * row_j[k]));
      row_j[k] = l;
    }
    row_j[j] = pivot;
    if (!(std::abs(pivot) > 1e-15 * largest)) inertia.singular = true;
    if (pivot < 0.0) ++inertia.negative;
  }
  return inertia;
}

/// Solves in place for `columns` right-hand sides, each contiguous with length n.
inline void solve_ldlt(const double* a, std::size_t n, double* b, std::size_t columns) {
  for (std::size_t c = 0; c < columns; ++c, b += n) {
    for (std::size_t j = 0; j < n; ++j) {
      double v = b[j];
      for (std::size_t k = 0; k < j; ++k) v -= a[j * n + k] * b[k];
      b[j] = v;
    }
    for (std::size_t j = 0; j < n; ++j) b[j] /= a[j * n + j];
    for (std::size_t j = n; j-- > 0;) {
      const double v = b[j];
      for (std::size_t k = 0; k < j; ++k) b[k] -= a[j * n + k] * v;
    }
  }
}

/// The same for a band matrix: row i holds entries i - width .. i at i (width + 1), columns left of
/// the matrix unused.
inline LdltInertia factorize_band_ldlt(double* a, std::size_t n, std::size_t width) {
  LdltInertia inertia;
  const std::size_t stride = width + 1;
  for (std::size_t j = 0; j < n; ++j) {
    double* row_j = a + j * stride + width - j;  // row_j[k] is entry (j, k)
    const std::size_t from = j > width ? j - width : 0;
    double largest = std::abs(row_j[j]);
    for (std::size_t k = from; k < j; ++k) {
      const double* row_k = a + k * stride + width - k;
      double v = row_j[k];
      for (std::size_t i = k > width ? std::max(from, k - width) : from; i < k; ++i)
        v -= row_j[i] * row_k[i];
      row_j[k] = v;
    }
    double pivot = row_j[j];
    for (std::size_t k = from; k < j; ++k) {
      const double l = row_j[k] / a[k * stride + width];
      pivot -= l * row_j[k];
      largest = std::fmax(largest, std::abs(l * row_j[k]));
      row_j[k] = l;
    }
    row_j[j] = pivot;
    if (!(std::abs(pivot) > 1e-15 * largest)) inertia.singular = true;
    if (pivot < 0.0) ++inertia.negative;
  }
  return inertia;
}

inline void solve_band_ldlt(const double* a, std::size_t n, std::size_t width, double* b,
                            std::size_t columns) {
  const std::size_t stride = width + 1;
  for (std::size_t c = 0; c < columns; ++c, b += n) {
    for (std::size_t j = 0; j < n; ++j) {
      const double* row = a + j * stride + width - j;
      double v = b[j];
      for (std::size_t k = j > width ? j - width : 0; k < j; ++k) v -= row[k] * b[k];
      b[j] = v;
    }
    for (std::size_t j = 0; j < n; ++j) b[j] /= a[j * stride + width];
    for (std::size_t j = n; j-- > 0;) {
      const double* row = a + j * stride + width - j;
      const double v = b[j];
      for (std::size_t k = j > width ? j - width : 0; k < j; ++k) b[k] -= row[k] * v;
    }
  }
}

}  // namespace flexura

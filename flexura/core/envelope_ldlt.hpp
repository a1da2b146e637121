#pragma once

#include <cstddef>
#include <vector>

namespace flexura {

/// The shape of a symmetric matrix whose entries lie near the diagonal: `last[j]` is the last row
/// with an entry in column j, and does not descend. The factors of such a matrix lie within.
class Envelope {
 public:
  Envelope() = default;
  explicit Envelope(std::vector<std::size_t> last);

  std::size_t size() const { return last_.size(); }
  std::size_t last(std::size_t column) const { return last_[column]; }
  std::size_t first(std::size_t row) const { return first_[row]; }
  /// Doubles that a matrix takes.
  std::size_t storage() const { return last_.size() * stride_; }
  /// Row i of a matrix: entry (i, j), first(i) <= j <= i, is at [j].
  double* row(double* a, std::size_t i) const { return a + i * (stride_ - 1) + stride_ - 1; }
  const double* row(const double* a, std::size_t i) const {
    return a + i * (stride_ - 1) + stride_ - 1;
  }

 private:
  std::vector<std::size_t> last_;
  std::vector<std::size_t> first_;
  std::size_t stride_ = 0;
};

/// What an elimination found.
struct EnvelopePivots {
  int negative = 0;
  bool weak = false;  ///< a pivot too small to divide by, with nothing after it eliminated
};

/// L D L^T of the first `pivots` columns, in place, without pivoting: L replaces what is below the
/// diagonal, D the diagonal, and the rest holds the Schur complement. Four columns at a time, so
/// that a row is read once for four of them.
EnvelopePivots eliminate(const Envelope& shape, std::size_t pivots, double* a);

/// b := L^-1 b of the eliminated columns, for `columns` (1 or 4) interleaved right-hand sides; what
/// is not eliminated gets its share. The first nonzero row of b is `start` or later.
void substitute_forward(const Envelope& shape, std::size_t pivots, const double* a,
                        std::size_t columns, std::size_t start, double* b);

/// x := L^-T x for one right-hand side whose entries behind the eliminated ones are solved already.
void substitute_back(const Envelope& shape, std::size_t pivots, const double* a, double* x);

}  // namespace flexura

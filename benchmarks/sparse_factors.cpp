// Factors of links of any shape: Eigen's simplicial L D L^T, which Flexura uses, against the
// supernodal (multifrontal) one of MUMPS, on matrices with the pattern of four-node elements.
// Processor times of one factorization, its analysis done before. MUMPS is as fast as the BLAS it
// is linked with; built only where its sequential version is found (Debian: libmumps-seq-dev).
#include <dmumps_c.h>
#include <fmt/format.h>

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <ctime>
#include <vector>

namespace {

using Matrix = Eigen::SparseMatrix<double>;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Lower triangle; two unknowns a node, each of which meets those of the eight around it.
Matrix grid_matrix(int columns, int rows) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
      for (int k = std::max(i - 1, 0); k <= std::min(i + 1, columns - 1); ++k)
        for (int l = std::max(j - 1, 0); l <= std::min(j + 1, rows - 1); ++l)
          for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b) {
              const int row = 2 * (i * rows + j) + a, column = 2 * (k * rows + l) + b;
              if (row >= column) entries.emplace_back(row, column, row == column ? 20.0 : -0.6);
            }
  Matrix matrix(2 * columns * rows, 2 * columns * rows);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template <class Factorize>
double least_seconds(const Factorize& factorize) {
  double least = INFINITY;
  for (int k = 0; k < 5; ++k) {
    const double start = processor_seconds();
    factorize();
    least = std::min(least, processor_seconds() - start);
  }
  return least;
}

double simplicial_seconds(const Matrix& matrix) {
  Eigen::SimplicialLDLT<Matrix> solver;
  solver.analyzePattern(matrix);
  return least_seconds([&] { solver.factorize(matrix); });
}

double mumps_seconds(const Matrix& matrix) {
  std::vector<MUMPS_INT> rows, columns;
  std::vector<double> values;
  for (int c = 0; c < matrix.outerSize(); ++c)
    for (Matrix::InnerIterator entry(matrix, c); entry; ++entry) {
      rows.push_back(static_cast<MUMPS_INT>(entry.row()) + 1);
      columns.push_back(static_cast<MUMPS_INT>(entry.col()) + 1);
      values.push_back(entry.value());
    }
  DMUMPS_STRUC_C solver{};
  const auto run = [&solver](MUMPS_INT job) {
    solver.job = job;
    dmumps_c(&solver);
  };
  solver.par = 1;
  solver.sym = 2;
  solver.comm_fortran = -987654;  // of the sequential version
  run(-1);
  std::fill_n(solver.icntl, 4, 0);  // prints nothing
  solver.n = static_cast<MUMPS_INT>(matrix.rows());
  solver.nnz = static_cast<MUMPS_INT8>(values.size());
  solver.irn = rows.data();
  solver.jcn = columns.data();
  solver.a = values.data();
  run(1);
  const double seconds = least_seconds([&] { run(2); });
  run(-2);
  return seconds;
}

}  // namespace

int main() {
  fmt::print("{:>10} {:>14} {:>10} {:>7}\n", "unknowns", "simplicial, s", "MUMPS, s", "ratio");
  for (const auto& [columns, rows] : {std::pair{30, 30}, {100, 60}, {200, 100}, {400, 100}}) {
    const Matrix matrix = grid_matrix(columns, rows);
    const double own = simplicial_seconds(matrix), other = mumps_seconds(matrix);
    fmt::print("{:>10} {:>14.4f} {:>10.4f} {:>7.2f}\n", matrix.rows(), own, other, own / other);
  }
  return 0;
}

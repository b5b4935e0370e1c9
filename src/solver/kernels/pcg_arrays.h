// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plain data only: this header goes into the kernels, see cmake/PalpateKernels.cmake.

namespace palpate::solver {

// Vectors have four components a node, the last one zero. Products with the matrix are computed in
// single precision: they take most of the time. The last entries of floats that make up the matrix
// are followed by at least eight more, all finite.

/// 3 x 3 blocks, column-major, row after row.
struct PcgBlocks {
  const int* row_start;
  const int* column;  ///< Node of each block.
  const float* values;
};

/// B^T M B, M = diag(weights): B by rows, and once more by columns.
struct PcgVolumes {
  const int* start;
  const int* node;       ///< Of each entry.
  const float* rows;     ///< 3 an entry.
  const float* weights;  ///< Of each row; null: the metric is applied by somebody else.
  const int* column_start;
  const int* pressure;  ///< Of each entry.
  const float* columns;
};

struct PcgVectors {
  double *x, *r, *z, *p, *Ap;
  float* p_single;  ///< p, rounded.
};

/// All from node (or pressure) `begin` to `end`.
struct PcgKernels {
  /// c = M B p, without M where there are no weights.
  void (*volumes)(const PcgVolumes&, int begin, int end, const float* p, float* c);
  /// Ap = K p + B^T c; returns p . Ap. `c` null: no volumes.
  double (*apply)(const PcgBlocks&, const PcgVolumes&, int begin, int end, const float* c,
                  const PcgVectors&);
  /// x += alpha p, r -= alpha Ap, z = D^-1 r; gives r . z and r . r.
  void (*update)(const float* inverse_diagonal, int begin, int end, double alpha, const PcgVectors&,
                 double* rz, double* rr);
  /// p = z + beta p, also in single precision.
  void (*direct)(int begin, int end, double beta, const PcgVectors&);
};

}  // namespace palpate::solver

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plain data only: this header goes into the kernels, see cmake/PalpateKernels.cmake.

namespace palpate::solver {

// Vectors have four components a node, the last one zero. Products with the matrix are computed in
// single precision: they take most of the time. The last entries of floats that make up the matrix
// are followed by at least eight more, all finite.

/// Rows of entries, sorted by length within each chunk of rows, so that a processor foresees where
/// each ends. Lengths are even: some rows are filled up with an entry of zeros.
struct PcgRows {
  const int* target;       ///< Node (or pressure) of each row.
  const int* start;        ///< Row r has the entries start[r] .. start[r + 1].
  const unsigned* source;  ///< 4 x node, or pressure, that an entry is multiplied with.
  const float* values;     ///< 9 an entry, column-major, or 3.
};

/// B^T M B, M = diag(weights): B by rows (pressures), and once more by columns (nodes).
struct PcgVolumes {
  PcgRows rows, columns;
  const float* weights;  ///< Of each pressure; null: the metric is applied by somebody else.
};

struct PcgVectors {
  double *x, *r, *z, *p, *Ap;
  float* p_single;  ///< p, rounded.
};

struct PcgKernels {
  /// to[k] = values[from[k]] for entries k of 9 (or 3) from `begin` to `end`; from -1: left alone.
  void (*pack9)(const int* from, int begin, int end, const double* values, float* to);
  void (*pack3)(const int* from, int begin, int end, const double* values, float* to);
  /// c = M B p from row `begin` to `end`, without M where there are no weights.
  void (*volumes)(const PcgVolumes&, int begin, int end, const float* p, float* c);
  /// Ap = K p + B^T c from row `begin` to `end`; returns p . Ap. `c` null: no volumes.
  double (*apply)(const PcgRows& K, const PcgVolumes&, int begin, int end, const float* c,
                  const PcgVectors&);
  /// += B^T M B into the 9 floats of each node's diagonal block.
  void (*diagonal)(const PcgVolumes&, int begin, int end, float* blocks);
  /// x += alpha p, r -= alpha Ap, z = D^-1 r from node `begin` to `end`; gives r . z and r . r.
  void (*update)(const float* inverse_diagonal, int begin, int end, double alpha, const PcgVectors&,
                 double* rz, double* rr);
  /// p = z + beta p, also in single precision, from node `begin` to `end`.
  void (*direct)(int begin, int end, double beta, const PcgVectors&);
};

}  // namespace palpate::solver

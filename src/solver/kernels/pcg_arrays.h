// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plain data only: this header goes into the kernels, see cmake/PalpateKernels.cmake.

namespace palpate::solver {

/// Rows that are worked through side by side, one in each lane.
constexpr int kSlice = 16;

// Vectors have the three components of the nodes of a slice one after the other: component c of the
// node in a lane of slice s is at 3 kSlice s + kSlice c + lane. Lanes beyond the last node are
// zero.

/// Sliced rows of entries. Rows of a slice are as long as the longest of them: the others are
/// filled up with entries of zeros.
struct PcgRows {
  const int* start;     ///< Slice s has the entries start[s] .. start[s + 1] of each of its rows.
  const int* source;    ///< [entry][lane]: where that begins which an entry is multiplied with.
  const float* values;  ///< [entry][component][lane]: 9 of a block, column-major, or 3.
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

/// Every kernel works on the slices from `begin` to `end`.
struct PcgKernels {
  /// The entries of `rows` into `to`, `size` numbers each: values[from[entry][lane]] and following,
  /// zeros where it is negative.
  void (*pack)(const int* start, const int* from, int size, int begin, int end,
               const double* values, float* to);
  /// c = M B p, without M where there are no weights.
  void (*volumes)(const PcgVolumes&, int begin, int end, const float* p, float* c);
  /// Ap = K p + B^T c; returns p . Ap. `c` null: no volumes.
  double (*apply)(const PcgRows& K, const PcgVolumes&, int begin, int end, const float* c,
                  const PcgVectors&);
  /// Inverses of the diagonal blocks of K, which begin at values[from[slice][lane]], with their
  /// part of B^T M B if there are volumes: [slice][xx xy yy xz yz zz][lane]. 0: one is not
  /// definite.
  int (*invert)(const double* values, const int* from, const PcgVolumes*, int begin, int end,
                float* inverse_diagonal);
  /// x += alpha p, r -= alpha Ap, z = D^-1 r; gives r . z and r . r.
  void (*update)(const float* inverse_diagonal, int begin, int end, double alpha, const PcgVectors&,
                 double* rz, double* rr);
  /// p = z + beta p, also in single precision.
  void (*direct)(int begin, int end, double beta, const PcgVectors&);
};

}  // namespace palpate::solver

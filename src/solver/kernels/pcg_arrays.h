// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plain data only: this header goes into the kernels, see cmake/PalpateKernels.cmake.

namespace palpate::solver {

/// Number of rows in a slice, one per lane.
constexpr int kSlice = 16;

// Vectors store the components of a slice's nodes separately: component c of the node in a lane of
// slice s is at 3 kSlice s + kSlice c + lane. Lanes beyond the last node are zero. Gathered vectors
// are stored by node instead: kNodeStride numbers each, the last zero, so that one load fetches a
// node.
constexpr int kNodeStride = 4;
/// Rows of dense matrices are padded to a multiple of this.
constexpr int kDenseRows = 32;

/// Sliced rows of entries. Rows of a slice are padded with zero entries to the length of the
/// longest.
struct PcgRows {
  const int* start;     ///< Slice s has the entries [start[s], start[s + 1]) of each row.
  const int* source;    ///< [entry][lane]: offset of the vector's factor of each entry.
  const float* values;  ///< [entry][component][lane]
};

/// Components of each entry that come from one source of values.
struct PcgPart {
  int first, count, size;  ///< Components first .. first + count - 1, of `size` in total.
  const int* from;         ///< [entry][lane]: their offset; negative: zeros.
};

/// B^T M B, M = diag(weights). Volume changes c = M B p are in slices: first those of home
/// pressures, at the position of their home node, with rows of B as part of K's; then the others.
struct PcgVolumes {
  PcgRows others;        ///< Rows of B of the other pressures, 3 numbers per entry.
  PcgRows columns;       ///< B by columns (nodes), 3 numbers per entry; sources are in c.
  const float* weights;  ///< Layout of c; null: the caller applies the metric.
  float* c;
};

struct PcgVectors {
  double *x, *r, *p;
  float *z, *Ap;
  float* p_nodes;  ///< p in single precision, by node.
};

/// Window of nodes within which slices are sorted.
constexpr int kWindow = 256;

/// Rigid motions of overlapping groups of nodes. A node moves by the sum over its groups of weight
/// (t + w x arm), except components with mask 0. Arms start at the centre of a window. A part is a
/// group within a window, a piece is a part within a slice.
struct PcgCoarse {
  const int* parts;           ///< Window w has the parts parts[w] .. parts[w + 1] - 1.
  const int* pieces;          ///< Part k has the pieces pieces[k] .. pieces[k + 1] - 1.
  const int* slice;           ///< Slice of each piece in its window.
  const float* weights;       ///< [piece][lane]
  const float* motions;       ///< t and w of each part.
  const int* start_of_slice;  ///< Slice s has the pieces piece_of_slice[start_of_slice[s] ..].
  const int* piece_of_slice;
  const int* part_of_slice;  ///< Part of each of these pieces.
  const float* mask;         ///< Layout of the vectors.
  const float* arm;          ///< Layout of the vectors.
};

/// Largest number of groups per node.
constexpr int kGroupsOfANode = 2;
/// Six rigid motions, padded.
constexpr int kMotions = 8;

/// The same P for A P, with motions of all groups about one point.
struct PcgMotions {
  const int* group;      ///< [node][kGroupsOfANode]
  const double* weight;  ///< [node][kGroupsOfANode]
  const double* motion;  ///< [node][component][kMotions]
  int groups;
  double* sums;  ///< [group][component][kMotions], workspace.
  int* reached;  ///< [group], workspace.
};

/// Kernels process the slices from `begin` to `end`.
struct PcgKernels {
  /// Packs one part of the entries: from[entry][lane] and following of `values`.
  void (*pack)(const int* start, const PcgPart&, int begin, int end, const double* values,
               float* to);
  /// Computes Ap = K p, K with 9 numbers per entry (blocks, column-major); returns p . Ap.
  double (*multiply)(const PcgRows& K, int begin, int end, const PcgVectors&);
  /// Computes Ap = K p and c = M B p of home pressures, K with 12 numbers per entry: the block,
  /// then that of B.
  void (*multiplyWithVolumes)(const PcgRows& K, const PcgVolumes&, int begin, int end,
                              const PcgVectors&);
  /// Computes c = M B p of the other pressures; `first` is their first slice of c.
  void (*changeOthers)(const PcgVolumes&, int first, int begin, int end, const PcgVectors&);
  /// Computes Ap += B^T c; returns p . Ap.
  double (*addVolumes)(const PcgVolumes&, int begin, int end, const PcgVectors&);
  /// Inverses of the diagonal blocks of K, at values[from[slice][lane]], with those of B^T M B if
  /// there are volumes: [slice][xx xy yy xz yz zz][lane]. Returns 0 if one is not positive
  /// definite.
  int (*invert)(const double* values, const int* from, const PcgVolumes*, int begin, int end,
                float* inverse_diagonal);
  /// Computes r -= alpha Ap and z = D^-1 r; gives r . z and r . r.
  void (*update)(const float* inverse_diagonal, int begin, int end, double alpha, const PcgVectors&,
                 double* rz, double* rr);
  /// Computes x += alpha p and p = z + beta p; `coarse`, if not null, adds its motion to z.
  void (*direct)(int begin, int end, double alpha, double beta, const PcgVectors&,
                 const PcgCoarse* coarse);
  /// Sums of weight r and weight arm x r, for each part of a group in the window of the slices.
  void (*restrictTo)(const PcgCoarse&, int begin, int end, const double* r, double* sums);
  /// Adds to C the part of P^T A P due to row i of A, with `count` blocks of nine in `columns`. C
  /// is [group a][group b >= a][6][kMotions].
  void (*addBlocks)(const PcgMotions&, int i, int count, const int* columns, const double* blocks,
                    double* C);
  /// Adds weight P^T b b^T P to C; b has three numbers for each of `columns`.
  void (*addSquare)(const PcgMotions&, int count, const int* columns, const double* b,
                    double weight, double* C);
  /// Rows [begin, end), multiples of kDenseRows, of y = A x; A has `columns` columns of `stride`
  /// rows.
  void (*multiplyDense)(const float* A, int columns, int stride, int begin, int end, const float* x,
                        float* y);
  /// Inverts A in place: symmetric positive semidefinite, n columns of `stride` rows. Rows and
  /// columns that depend on earlier ones are left out.
  void (*invertDense)(int n, int stride, double* A);
};

}  // namespace palpate::solver

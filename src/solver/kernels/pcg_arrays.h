// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plain data only: this header goes into the kernels, see cmake/PalpateKernels.cmake.

namespace palpate::solver {

/// Rows that are worked through side by side, one in each lane.
constexpr int kSlice = 16;

// Vectors have the three components of the nodes of a slice one after the other: component c of the
// node in a lane of slice s is at 3 kSlice s + kSlice c + lane. Lanes beyond the last node are
// zero. What is gathered from lies node by node instead: kNodeStride numbers each, the last zero,
// so that a node is fetched by one load.
constexpr int kNodeStride = 4;
/// Rows of dense matrices are filled up to a multiple of this.
constexpr int kDenseRows = 32;

/// Sliced rows of entries. Rows of a slice are as long as the longest of them: the others are
/// filled up with entries of zeros.
struct PcgRows {
  const int* start;     ///< Slice s has the entries start[s] .. start[s + 1] of each of its rows.
  const int* source;    ///< [entry][lane]: where that begins which an entry is multiplied with.
  const float* values;  ///< [entry][component][lane]
};

/// A part of the components of each entry, and where its values come from.
struct PcgPart {
  int first, count, size;  ///< Components first .. first + count, of `size` all in all.
  const int* from;         ///< [entry][lane]: where they begin; negative: zeros.
};

/// B^T M B, M = diag(weights). Changes c = M B p lie in slices: first those of pressures that are
/// at home at the node in the same place, whose rows of B are part of K's; then the others.
struct PcgVolumes {
  PcgRows others;        ///< Rows of B of the others, 3 numbers an entry.
  PcgRows columns;       ///< B by columns (nodes), 3 numbers an entry; sources lie in c.
  const float* weights;  ///< As c; null: the metric is applied by somebody else.
  float* c;
};

struct PcgVectors {
  double *x, *r, *p;
  float *z, *Ap;
  float* p_nodes;  ///< p, rounded, node by node.
};

/// Nodes are sorted within windows of so many.
constexpr int kWindow = 256;

/// Something that moves overlapping groups of nodes as rigid bodies: a node by the sum over its
/// groups of weight (t + w x arm), but for those of its components whose mask is 0, not 1. Arms are
/// from the middle of a window. What a window has of a group is a part, what a slice has of a part
/// a piece.
struct PcgCoarse {
  const int* parts;           ///< Window w has the parts parts[w] .. parts[w + 1].
  const int* pieces;          ///< Part k has the pieces pieces[k] .. pieces[k + 1].
  const int* slice;           ///< Of each piece, in its window.
  const float* weights;       ///< [piece][lane]
  const float* motions;       ///< t and w of each part.
  const int* start_of_slice;  ///< Slice s has the pieces piece_of_slice[start_of_slice[s] ..].
  const int* piece_of_slice;
  const int* part_of_slice;  ///< The same pieces' parts.
  const float* mask;         ///< As the vectors.
  const float* arm;          ///< As the vectors.
};

/// Groups that a node has a part in, at most.
constexpr int kGroupsOfANode = 2;
/// The six motions of a rigid body, filled up.
constexpr int kMotions = 8;

/// The same P for A P: the motions of all groups are about one point.
struct PcgMotions {
  const int* group;      ///< [node][kGroupsOfANode]
  const double* weight;  ///< [node][kGroupsOfANode]
  const double* motion;  ///< [node][component][kMotions]
  int groups;
  double* sums;  ///< [group][component][kMotions], for kernels to write to.
  int* reached;  ///< [group], the same.
};

/// Every kernel works on the slices from `begin` to `end`.
struct PcgKernels {
  /// Takes one part of the entries: from[entry][lane] and following of `values`.
  void (*pack)(const int* start, const PcgPart&, int begin, int end, const double* values,
               float* to);
  /// Ap = K p, K with 9 numbers an entry (blocks, column-major); returns p . Ap.
  double (*multiply)(const PcgRows& K, int begin, int end, const PcgVectors&);
  /// Ap = K p and c = M B p of the pressures at home, K with 12 numbers an entry: those of the
  /// block, then those of B.
  void (*multiplyWithVolumes)(const PcgRows& K, const PcgVolumes&, int begin, int end,
                              const PcgVectors&);
  /// c = M B p of others; `first` is the slice of c where they begin.
  void (*changeOthers)(const PcgVolumes&, int first, int begin, int end, const PcgVectors&);
  /// Ap += B^T c; returns p . Ap.
  double (*addVolumes)(const PcgVolumes&, int begin, int end, const PcgVectors&);
  /// Inverses of the diagonal blocks of K, which begin at values[from[slice][lane]], with their
  /// part of B^T M B if there are volumes: [slice][xx xy yy xz yz zz][lane]. 0: one is not
  /// definite.
  int (*invert)(const double* values, const int* from, const PcgVolumes*, int begin, int end,
                float* inverse_diagonal);
  /// r -= alpha Ap, z = D^-1 r; gives r . z and r . r.
  void (*update)(const float* inverse_diagonal, int begin, int end, double alpha, const PcgVectors&,
                 double* rz, double* rr);
  /// x += alpha p, p = z + beta p; `coarse`, which may be null, adds its motion to z.
  void (*direct)(int begin, int end, double alpha, double beta, const PcgVectors&,
                 const PcgCoarse* coarse);
  /// For each part of a group in the window, in which the slices are: the sums of weight r and of
  /// weight arm x r.
  void (*restrictTo)(const PcgCoarse&, int begin, int end, const double* r, double* sums);
  /// C += P^T A P, as far as row i of A adds to it, which has `count` blocks of nine in `columns`.
  /// C is [group a][group b >= a][6][kMotions].
  void (*addBlocks)(const PcgMotions&, int i, int count, const int* columns, const double* blocks,
                    double* C);
  /// C += weight P^T b b^T P, b with three numbers in each of `columns`.
  void (*addSquare)(const PcgMotions&, int count, const int* columns, const double* b,
                    double weight, double* C);
  /// Rows `begin` to `end`, multiples of kDenseRows, of y = A x, A with `columns` columns of
  /// `stride` rows.
  void (*multiplyDense)(const float* A, int columns, int stride, int begin, int end, const float* x,
                        float* y);
  /// The inverse of A, symmetric and positive semidefinite with n columns of `stride` rows, without
  /// the rows and columns that follow from those before.
  void (*invertDense)(int n, int stride, double* A);
};

}  // namespace palpate::solver

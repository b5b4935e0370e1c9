// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Tetrahedra of N nodes in batches, component by component, and the loops over them. Plain data
// only: this header goes into the kernels, see cmake/PalpateKernels.cmake.

namespace palpate::fem {

constexpr int kBatchSize = 8;

/// Number of integration points of an element.
template <int N>
constexpr int kTetPoints = N == 4 ? 1 : 4;

/// Linear elements have ascending nodes; quadratic ones, with edges straight at rest, the order of
/// TetMesh. Unused lanes of the last batch repeat the previous element.
template <int N>
struct alignas(64) TetBatch {
  int node[N][kBatchSize];            ///< 3 x node: offset of its coordinates.
  double gradient[3][3][kBatchSize];  ///< [k][c]: d w_{k+1} / dX_c of the barycentric coordinates
                                      ///< [1/m]; that of w_0 is minus the sum.
  double volume[kBatchSize];          ///< [m^3]
};

/// Offsets of an element's blocks (a, b), a < b, in the matrix values, row after row; ~offset if
/// node a has the higher number, for the transposed block. Diagonal blocks follow by translation
/// invariance.
template <int N>
struct alignas(64) TetBlocks {
  int offset[N * (N - 1) / 2][kBatchSize];
};

/// Pressures at the corners of an element.
template <int N>
struct alignas(64) TetPressures {
  int corner[4][kBatchSize];         ///< Index of each corner's pressure.
  int row[4 * (N - 1)][kBatchSize];  ///< 3 x entry of node a in the row of corner k's pressure,
                                     ///< [(N-1) k + l], with a the l-th other node.
};

/// Symmetric tensors at eight points, for example stresses: xx yy zz xy yz zx.
struct alignas(64) SymmetricBatch {
  double component[6][kBatchSize];
};

/// For det F at or below this, S = F^-1 P is taken as zero. S is unbounded towards det F = 0, and
/// viscous memory of inverted elements would cause unbounded forces in later steps.
constexpr double kNoStress = 1e-3;

/// Material laws with kernels.
enum class TetLaw { kNeoHookean, kStableNeoHookean };

/// Consecutive batches of elements of one solid.
struct TetRun {
  TetLaw law;
  double mu, kappa;  ///< [Pa]; kappa is the elements' own part.
  int first_batch, num_elements;
  int solid;
  int first_memory;  ///< First batch of viscous memory; points of an element are consecutive. -1:
                     ///< not viscous.
};

template <int N>
struct TetArrays {
  const TetBatch<N>* batches;
  const TetBlocks<N>* blocks;
  const TetPressures<N>* pressures;  ///< Null without nodal pressures.
  double* J;                         ///< [batch][point][element]
  double* energy;                    ///< [batch] [J]
  const SymmetricBatch* viscous;     ///< H of viscous runs [Pa], see PronyHistory.
  const double* factor;  ///< Factor of the distortional energy of each solid; 1 if not viscous.
};

template <int N>
struct TetKernels {
  using Arrays = TetArrays<N>;
  /// J at x, and += N_n V (J - 1) of all points to the volume changes of the corners' pressures.
  void (*deform)(const Arrays&, const TetRun&, const double* x, double* volume_changes);
  /// Energies at x, without that of nodal pressures.
  void (*energy)(const Arrays&, const TetRun&, const double* x);
  /// The energies, and += the gradient to g; `pressure` [Pa] of the pressure nodes.
  void (*gradient)(const Arrays&, const TetRun&, const double* x, const double* pressure,
                   double* g);
  /// Adds element matrices to the blocks above the diagonal and N_n V dJ/dx to `rows`.
  void (*hessian)(const Arrays&, const TetRun&, const double* x, const double* pressure,
                  double* blocks, double* rows);
  /// Second Piola-Kirchhoff stress of the distortional energy, factor 1, at x [Pa] to the batches S
  /// of a viscous run.
  void (*stress)(const Arrays&, const TetRun&, const double* x, SymmetricBatch* S);
};

/// Expands a row of blocks: `lower` transposed blocks of upper[9 index], minus the sum's symmetric
/// part, then `higher` blocks unchanged.
using ExpandRow = void (*)(const int* index, int lower, int higher, const double* upper,
                           double* row);

}  // namespace palpate::fem

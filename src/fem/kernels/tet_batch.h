// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Tetrahedra of N nodes in batches, component by component, and the loops over them. Plain data
// only: this header goes into the kernels, see cmake/PalpateKernels.cmake.

namespace palpate::fem {

constexpr int kBatchSize = 8;

/// Integration points of an element.
template <int N>
constexpr int kTetPoints = N == 4 ? 1 : 4;

/// Nodes of a linear element ascend; those of a quadratic one, whose edges are straight at rest,
/// come as in TetMesh. Unused elements of a last batch repeat the one before.
template <int N>
struct alignas(64) TetBatch {
  int node[N][kBatchSize];            ///< 3 x node: where its coordinates begin.
  double gradient[3][3][kBatchSize];  ///< [k][c]: d w_{k+1} / dX_c of the barycentric coordinates
                                      ///< [1/m]; of w_0 minus the sum.
  double volume[kBatchSize];          ///< [m^3]
};

/// Where an element's matrix goes: offsets into the values of the blocks (a, b), a < b, row after
/// row; ~offset where node a is the higher one: then the transposed block is there. The diagonal
/// blocks follow from them: a shift of all nodes changes no force.
template <int N>
struct alignas(64) TetBlocks {
  int offset[N * (N - 1) / 2][kBatchSize];
};

/// What an element has to do with the pressures at its corners.
template <int N>
struct alignas(64) TetPressures {
  int corner[4][kBatchSize];         ///< Pressure of each corner.
  int row[4 * (N - 1)][kBatchSize];  ///< 3 x entry of node a in the row of corner k's pressure,
                                     ///< [(N-1) k + l], a the l-th of the other nodes.
};

/// Symmetric tensors at eight points, such as stresses: xx yy zz xy yz zx.
struct alignas(64) SymmetricBatch {
  double component[6][kBatchSize];
};

/// Det F of a point up to which S = F^-1 P is taken to be zero: towards 0 it grows without bound,
/// and what an element that is inside out had of it would pull without bound in the steps after.
constexpr double kNoStress = 1e-3;

/// Laws that the kernels know.
enum class TetLaw { kNeoHookean, kStableNeoHookean };

/// Elements of one solid, one batch after another.
struct TetRun {
  TetLaw law;
  double mu, kappa;  ///< [Pa]; kappa is what the elements themselves have.
  int first_batch, num_elements;
  int solid;
  int first_memory;  ///< Of its batches of viscous memory, in which the points of an element follow
                     ///< one another; -1: the solid is not viscous.
};

template <int N>
struct TetArrays {
  const TetBatch<N>* batches;
  const TetBlocks<N>* blocks;
  const TetPressures<N>* pressures;  ///< Null without nodal pressures.
  double* J;                         ///< [batch][point][element]
  double* energy;                    ///< [batch] [J]
  const SymmetricBatch* viscous;     ///< H of viscous runs [Pa], see PronyHistory.
  const double* factor;  ///< Of the distortional energy of each solid, if it is viscous.
};

template <int N>
struct TetKernels {
  using Arrays = TetArrays<N>;
  /// J at x, and += N_n V (J - 1) of all points into the volume changes of the corners' pressures.
  void (*deform)(const Arrays&, const TetRun&, const double* x, double* volume_changes);
  /// Energies at x, without those of pressures.
  void (*energy)(const Arrays&, const TetRun&, const double* x);
  /// The same, and += the gradient into g; `pressure` [Pa] of the pressure nodes.
  void (*gradient)(const Arrays&, const TetRun&, const double* x, const double* pressure,
                   double* g);
  /// += element matrices into the blocks above the diagonal, += N_n V dJ/dx into `rows`.
  void (*hessian)(const Arrays&, const TetRun&, const double* x, const double* pressure,
                  double* blocks, double* rows);
  /// Second Piola-Kirchhoff stress of the distortional energy, factor 1, at x [Pa] into the batches
  /// S of a viscous run.
  void (*stress)(const Arrays&, const TetRun&, const double* x, SymmetricBatch* S);
};

/// A row of blocks: `lower` of them as the transposed of upper[9 index], minus the sum's symmetric
/// part, `higher` of them as they are.
using ExpandRow = void (*)(const int* index, int lower, int higher, const double* upper,
                           double* row);

}  // namespace palpate::fem

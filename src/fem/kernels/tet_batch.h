// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Linear tetrahedra in batches, component by component, and the loops over them. Plain data only:
// this header goes into the kernels, see cmake/PalpateKernels.cmake.

namespace palpate::fem {

constexpr int kBatchSize = 8;

/// Nodes of an element ascend. Unused elements of a last batch repeat the one before.
struct alignas(64) TetBatch {
  int node[4][kBatchSize];            ///< 3 x node: where its coordinates begin.
  double gradient[3][3][kBatchSize];  ///< [a][c]: d N_{a+1} / dX_c [1/m]; of N_0 minus the sum.
  double volume[kBatchSize];          ///< [m^3]
};

/// Where an element's matrix goes: offsets into the values of the blocks (a, b), a < b, row after
/// row. The diagonal blocks follow from them: a shift of all nodes changes no force.
struct alignas(64) TetBlocks {
  int offset[6][kBatchSize];
};

/// What an element has to do with nodal pressures.
struct alignas(64) TetPressures {
  int corner[4][kBatchSize];  ///< Pressure of each node.
  int row[12][kBatchSize];    ///< 3 x entry of node a in the row of node k's pressure, [3 k + l]
                              ///< with a the l-th of the other three nodes.
};

/// Symmetric tensors at eight points, such as stresses: xx yy zz xy yz zx.
struct alignas(64) SymmetricBatch {
  double component[6][kBatchSize];
};

/// Laws that the kernels know.
enum class TetLaw { kNeoHookean, kStableNeoHookean };

/// Elements of one solid, one batch after another.
struct TetRun {
  TetLaw law;
  double mu, kappa;  ///< [Pa]; kappa is what the elements themselves have.
  int first_batch, num_elements;
  int solid;
  int first_memory;  ///< Of its batches of viscous memory; -1: the solid is not viscous.
};

struct TetArrays {
  const TetBatch* batches;
  const TetBlocks* blocks;
  const TetPressures* pressures;  ///< Null without nodal pressures.
  double* J;                      ///< [batch][element]
  double* energy;                 ///< [batch] [J]
  const SymmetricBatch* viscous;  ///< H of viscous runs [Pa], see PronyHistory.
  const double* factor;           ///< Of the distortional energy of each solid, if it is viscous.
};

struct TetKernels {
  /// J at x, and += V/4 (J - 1) into the volume changes of the corners' pressures.
  void (*deform)(const TetArrays&, const TetRun&, const double* x, double* volume_changes);
  /// Energies at x, without those of pressures.
  void (*energy)(const TetArrays&, const TetRun&, const double* x);
  /// The same, and += the gradient into g; `pressure` [Pa] of the pressure nodes.
  void (*gradient)(const TetArrays&, const TetRun&, const double* x, const double* pressure,
                   double* g);
  /// += element matrices into the blocks above the diagonal, += V/4 dJ/dx into `rows`.
  void (*hessian)(const TetArrays&, const TetRun&, const double* x, const double* pressure,
                  double* blocks, double* rows);
  /// Second Piola-Kirchhoff stress of the distortional energy, factor 1, at x [Pa] into the batches
  /// S of a viscous run.
  void (*stress)(const TetArrays&, const TetRun&, const double* x, SymmetricBatch* S);
  /// A row of blocks: `lower` of them as the transposed of upper[9 index], minus the sum's
  /// symmetric part, `higher` of them as they are.
  void (*expand)(const int* index, int lower, int higher, const double* upper, double* row);
};

}  // namespace palpate::fem

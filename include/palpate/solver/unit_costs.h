// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace palpate::solver {

// What work costs in seconds, to choose between ways that lead to the same end. Measured once
// (gcc 12 -O3, AVX-512, 2.3 GHz, OpenBLAS 0.3.21 with OPENBLAS_CORETYPE=SKYLAKEX, one thread) and
// fixed in the source: choices must not depend on a clock. CHOLMOD factorised a 20,250 tetrahedra
// cube with 36e9 multiplications and additions a second, a 4,374 one with half of that; its
// triangular solves read the factor twice, 2 x 36 MB in 3.0 ms. The kernels of elements and of
// conjugate gradients were timed on 20,000 tetrahedra, or 3,072 quadratic ones, of stable
// neo-Hookean tissue; the former anew on an AMD EPYC.

/// By CHOLMOD.
inline double factorizationSeconds(double flops) { return flops / 20.0e9; }
/// Forward and backward.
inline double triangularSolveSeconds(double nonzeros) { return 2.0 * 8.0 * nonzeros / 22.0e9; }

/// What tetrahedra are, to count what they cost.
struct TetCounts {
  double number = 0.0;
  bool quadratic = false;
  bool averaged = false;  ///< With nodal volumes.
};

/// Energy and its gradient.
inline double gradientSeconds(const TetCounts& tets) {
  const double of_one =
      tets.quadratic ? (tets.averaged ? 52.0e-9 : 33.0e-9) : (tets.averaged ? 15.0e-9 : 9.3e-9);
  return of_one * tets.number;
}
/// Gradient and tangent matrix.
inline double tangentSeconds(const TetCounts& tets) {
  const double of_one =
      tets.quadratic ? (tets.averaged ? 393.0e-9 : 323.0e-9) : (tets.averaged ? 52.0e-9 : 36.0e-9);
  return of_one * tets.number;
}
/// Of the matrix for BlockPcg, for 3 x 3 blocks.
inline double packingSeconds(double blocks) { return 3.6e-9 * blocks; }
/// One iteration of BlockPcg, for 3 x 3 blocks and entries of VolumeStiffness::rows.
inline double pcgIterationSeconds(double blocks, double volume_entries) {
  return 1.3e-9 * blocks + 1.3e-9 * volume_entries;
}

}  // namespace palpate::solver

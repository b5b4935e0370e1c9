// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace palpate::solver {

// What work costs in seconds, to choose between ways that lead to the same end. Measured once
// (gcc 12 -O3, AVX-512, 2.3 GHz, OpenBLAS 0.3.21 with OPENBLAS_CORETYPE=SKYLAKEX, one thread) and
// fixed in the source: choices must not depend on a clock. CHOLMOD factorised a 20,250 tetrahedra
// cube with 36e9 multiplications and additions a second, a 4,374 one with half of that; its
// triangular solves read the factor twice, 2 x 36 MB in 3.0 ms. The kernels of elements and of
// conjugate gradients were timed on 20,000 tetrahedra of stable neo-Hookean tissue.

/// By CHOLMOD.
inline double factorizationSeconds(double flops) { return flops / 20.0e9; }
/// Forward and backward.
inline double triangularSolveSeconds(double nonzeros) { return 2.0 * 8.0 * nonzeros / 22.0e9; }

/// Energy and its gradient, of linear tetrahedra; `averaged`: with nodal volumes.
inline double gradientSeconds(double tets, bool averaged) {
  return (averaged ? 21.0e-9 : 13.5e-9) * tets;
}
/// Gradient and tangent matrix.
inline double tangentSeconds(double tets, bool averaged) {
  return (averaged ? 90.0e-9 : 62.0e-9) * tets;
}
/// Of the matrix for BlockPcg.
inline double packingSeconds(double tets) { return 10.0e-9 * tets; }
/// One iteration of BlockPcg, for 3 x 3 blocks and entries of VolumeStiffness::rows.
inline double pcgIterationSeconds(double blocks, double volume_entries) {
  return 1.3e-9 * blocks + 1.3e-9 * volume_entries;
}

}  // namespace palpate::solver

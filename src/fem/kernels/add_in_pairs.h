// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// For kernels only: += of three numbers that lie side by side, as a pair and one.

#include "tet_batch.h"

namespace palpate::fem {
namespace {

typedef double Pair __attribute__((vector_size(16)));
typedef double PairInMemory __attribute__((vector_size(16), aligned(8), may_alias));

// Two numbers and one, each time the same way: a processor passes a number that was just stored on
// to the next load only if both are of the same place and width.
inline void addThree(Pair xy, double z, double* at) {
  *reinterpret_cast<PairInMemory*>(at) += xy;
  at[2] += z;
}

// To the nodes of a batch: force[3 a + component][element] at node a.
template <int N>
inline void addForces(const double (*force)[kBatchSize], const TetBatch<N>& batch, int count,
                      double* g) {
  for (int e = 0; e < count; ++e) {
    for (int a = 0; a < N; ++a) {
      const Pair xy = {force[3 * a][e], force[3 * a + 1][e]};
      addThree(xy, force[3 * a + 2][e], g + batch.node[a][e]);
    }
  }
}

// Into the rows of the nodes' pressures: the gradients of an element's volume with respect to the
// other three nodes.
inline void addRows(const double (*dilatation)[kBatchSize], const int (*row)[kBatchSize], int count,
                    double* rows) {
  for (int e = 0; e < count; ++e) {
    for (int a = 0; a < 4; ++a) {
      const Pair xy = {dilatation[3 * a][e], dilatation[3 * a + 1][e]};
      const double z = dilatation[3 * a + 2][e];
      for (int k = 0; k < 4; ++k) {
        if (k != a) addThree(xy, z, rows + row[3 * k + (a < k ? a : a - 1)][e]);
      }
    }
  }
}

}  // namespace
}  // namespace palpate::fem

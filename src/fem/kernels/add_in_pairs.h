// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// For kernels only: adds three consecutive numbers as a pair and a single.

#include "tet_batch.h"

namespace palpate::fem {
namespace {

typedef double Pair __attribute__((vector_size(16)));
typedef double PairInMemory __attribute__((vector_size(16), aligned(8), may_alias));

// Pair, then single, always in the same widths: store-to-load forwarding needs the same address and
// width.
inline void addThree(Pair xy, double z, double* at) {
  *reinterpret_cast<PairInMemory*>(at) += xy;
  at[2] += z;
}

// Adds forces of a batch to its nodes: force[3 a + component][element] at node a.
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

// Adds the gradients of an element's volume by the other three nodes to the rows of the pressures.
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

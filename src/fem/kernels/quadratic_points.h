// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// For kernels only: quadratic tetrahedra with edges straight at rest, at the four points of their
// rule. w_k(q) is the barycentric coordinate of point q: kNear for k = q, else kFar. x_kl is the
// node between corners k and l, x_kk the corner. The derivatives dx/dw_k at q are
//
//   y_k(q) = sum_l 4 w_l x_kl - x_k = (4 kFar - 1) x_k + 4 kFar sum_{l != k} x_kl + kMore x_kq,
//
// with kMore = 4 (kNear - kFar), so F(q) = sum_k y_k(q) (x) grad w_k needs one more node per point.
// Forces and stiffnesses are the transpose: node (k, l) gets kOnEdge, a corner kOnCorner, times its
// ends' sums over all points, plus kMore times k's value at point l and l's at point k.

#include "lane_vectors.h"
#include "tet_batch.h"

namespace palpate::fem {
namespace {

constexpr double kFar = 0.1381966011250105, kNear = 0.5854101966249685;  // see shape_functions.h
constexpr double kMore = 4.0 * (kNear - kFar);
constexpr double kOnCorner = 4.0 * kFar - 1.0, kOnEdge = 4.0 * kFar;

/// Node between two corners; a corner with itself: that corner.
constexpr int kBetween[4][4] = {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3}};
/// The two corners that a node lies between.
constexpr int kEnds[10][2] = {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {0, 1},
                              {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

inline double onNode(int a) { return a < 4 ? kOnCorner : kOnEdge; }

struct Quadratic {
  Vec x[10];  // from node 0
  Vec s[4];   // y_k(q) without kMore x_kq
  Vec g[3];   // grad w_k of corners 1, 2, 3
};

inline Quadratic quadraticAt(const TetBatch<10>& batch, int lane, const double* x) {
  Quadratic e;
  Vec origin;
  for (int i = 0; i < 3; ++i) origin.v[i] = gather(x + i, batch.node[0] + lane);
  for (int a = 0; a < 10; ++a) {
    for (int i = 0; i < 3; ++i) e.x[a].v[i] = gather(x + i, batch.node[a] + lane) - origin.v[i];
  }
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < 3; ++i) {
      Lanes sum{};
      for (int l = 0; l < 4; ++l) {
        if (l != k) sum += e.x[kBetween[k][l]].v[i];
      }
      e.s[k].v[i] = kOnCorner * e.x[k].v[i] + kOnEdge * sum;
    }
  }
  for (int k = 0; k < 3; ++k) {
    for (int c = 0; c < 3; ++c) e.g[k].v[c] = load(batch.gradient[k][c] + lane);
  }
  return e;
}

inline Mat deformation(const Quadratic& e, int q) {
  Mat F{};
  for (int k = 1; k < 4; ++k) {
    Vec y;
    for (int i = 0; i < 3; ++i) {
      y.v[i] = (e.s[k].v[i] - e.s[0].v[i]) +
               kMore * (e.x[kBetween[k][q]].v[i] - e.x[kBetween[0][q]].v[i]);
    }
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) F.col[j].v[i] += y.v[i] * e.g[k - 1].v[j];
    }
  }
  return F;
}

/// Pressures of the corners, interpolated to point q.
struct CornerPressures {
  Lanes far_sum, p[4];
  Lanes at(int q) const { return far_sum + (kNear - kFar) * p[q]; }
};
/// Corner pressures of a batch; does not read `batches` without pressure.
inline CornerPressures cornerPressures(const TetPressures<10>* batches, int batch, int lane,
                                       const double* pressure) {
  CornerPressures at{};
  if (!pressure) return at;
  for (int k = 0; k < 4; ++k) at.p[k] = gather(pressure, batches[batch].corner[k] + lane);
  at.far_sum = kFar * ((at.p[0] + at.p[1]) + (at.p[2] + at.p[3]));
  return at;
}

/// First memory slot of point 0 of each element of a batch. Points of an element are consecutive;
/// two elements share a SymmetricBatch.
struct MemorySlots {
  int at[kBatchSize];
};
inline MemorySlots memorySlots(int count) {
  MemorySlots places;
  for (int e = 0; e < kBatchSize; ++e) {
    const int k = e < count ? e : count - 1;
    places.at[e] =
        static_cast<int>(sizeof(SymmetricBatch) / sizeof(double)) * (k / 2) + 4 * (k % 2);
  }
  return places;
}

}  // namespace
}  // namespace palpate::fem

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// For kernels only: element matrices of quadratic tetrahedra. At each point q, the matrix G_kl(q)
// of a linear tetrahedron between corners contributes to nodes a and b by their ends
// (quadratic_points.h):
//
//   K_ab = sum of k in a, l in b:  c_a c_b sum_q G_kl(q) + c_a kMore G_kl(k_b)
//                                  + c_b kMore G_kl(l_a) + [l_a = k_b] kMore^2 G_kl(l_a),
//
// with c_a = kOnCorner or kOnEdge, l_a the other end of a, k_b that of b.

#include "add_in_pairs.h"
#include "palpate/base/lanes.h"
#include "quadratic_points.h"
#include "tet_stiffness.h"

namespace palpate::fem {
namespace {

/// Index of G_kl, k <= l, in a list; G_lk is its transpose.
constexpr int kPair[4][4] = {{0, 1, 2, 3}, {1, 4, 5, 6}, {2, 5, 7, 8}, {3, 6, 8, 9}};

/// Matrices between the corners of a batch's elements at all points, and their sums.
class CornerBlocks {
 public:
  /// `onIdentity(m, n)`: factor of I for the gradients m and n, without the volume.
  template <class Point, class OnIdentity>
  void set(int q, int lane, const Point& point, Lanes volume, const Mat& F, const Mat& cof,
           const Vec* g, const OnIdentity& onIdentity) {
    Vec f[3], c[3];
    for (int k = 0; k < 3; ++k) {
      f[k] = times(F, g[k]);
      c[k] = times(cof, g[k]);
    }
    Mat G[3][3];
    for (int k = 0; k < 3; ++k) {
      for (int l = k; l < 3; ++l) {
        G[k][l] = block(point, volume, onIdentity(g[k], g[l]), f[k], c[k], f[l], c[l]);
        if (l == k) continue;
        addSpin(volume * point.c, times(F, cross(g[k], g[l])), &G[k][l]);
        G[l][k] = transposed(G[k][l]);
      }
    }
    Mat to_first[3];  // G_0l
    for (int l = 0; l < 3; ++l) {
      to_first[l] = minusSum(G[0][l], G[1][l], G[2][l]);
      put(q, 0, l + 1, lane, to_first[l]);
      for (int k = 0; k <= l; ++k) put(q, k + 1, l + 1, lane, G[k][l]);
    }
    put(q, 0, 0, lane, minusSum(to_first[0], to_first[1], to_first[2]));
  }

  void sum(int lane) {
    for (int n = 0; n < 90; ++n) {
      store(sum_[n] + lane, (load(at_[0][n] + lane) + load(at_[1][n] + lane)) +
                                (load(at_[2][n] + lane) + load(at_[3][n] + lane)));
    }
  }

  /// Adds the blocks between all pairs of nodes to the matrix values.
  void addTo(const TetBlocks<10>& blocks, int count, double* to) const {
    int pair = 0;
    for (int a = 0; a < 10; ++a) {
      for (int b = a + 1; b < 10; ++b, ++pair) {
        const int* offset = blocks.offset[pair];
        alignas(64) double values[9][kBatchSize];
        for (int lane = 0; lane < kBatchSize; lane += kWidth) {
          const Mat K = between(a, b, lane);
          const LaneBits other_way = belowZero(offset + lane);
          for (int j = 0; j < 3; ++j) {
            for (int i = 0; i < 3; ++i) {
              store(values[3 * j + i] + lane, select(other_way, K.col[i].v[j], K.col[j].v[i]));
            }
          }
        }
        int where[kBatchSize];
        for (int e = 0; e < kBatchSize; ++e) where[e] = offset[e] ^ (offset[e] >> 31);
        addNines(values, where, count, to);
      }
    }
  }

 private:
  void put(int q, int k, int l, int lane, const Mat& G) {
    for (int c = 0; c < 9; ++c) store(at_[q][9 * kPair[k][l] + c] + lane, G.col[c / 3].v[c % 3]);
  }

  /// Adds s G_kl of one of the arrays to K.
  static void add(double s, const double (*G)[kBatchSize], int k, int l, int lane, Mat* K) {
    const double(*at)[kBatchSize] = G + 9 * kPair[k][l];
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) {
        K->col[j].v[i] += s * load(at[k <= l ? 3 * j + i : 3 * i + j] + lane);
      }
    }
  }

  Mat between(int a, int b, int lane) const {
    Mat K{};
    for (int m = 0; m < (a < 4 ? 1 : 2); ++m) {
      const int k = kEnds[a][m], l_a = kEnds[a][1 - m];
      for (int n = 0; n < (b < 4 ? 1 : 2); ++n) {
        const int l = kEnds[b][n], k_b = kEnds[b][1 - n];
        add(onNode(a) * onNode(b), sum_, k, l, lane, &K);
        if (l_a == k_b) {
          add((onNode(a) + onNode(b) + kMore) * kMore, at_[l_a], k, l, lane, &K);
        } else {
          add(onNode(a) * kMore, at_[k_b], k, l, lane, &K);
          add(onNode(b) * kMore, at_[l_a], k, l, lane, &K);
        }
      }
    }
    return K;
  }

  alignas(64) double at_[4][90][kBatchSize];
  alignas(64) double sum_[90][kBatchSize];
};

/// Gradients of the corners' volume changes by all nodes, from r_k(q) = V/4 cof F(q) grad w_k.
inline void storeDilatations(const Vec (*r)[4], int lane, double (*dilatation)[30][kBatchSize]) {
  for (int i = 0; i < 3; ++i) {
    Lanes sum[4];
    for (int k = 0; k < 4; ++k) {
      sum[k] = (r[0][k].v[i] + r[1][k].v[i]) + (r[2][k].v[i] + r[3][k].v[i]);
    }
    for (int n = 0; n < 4; ++n) {
      for (int a = 0; a < 10; ++a) {
        Lanes total{};
        for (int m = 0; m < (a < 4 ? 1 : 2); ++m) {
          const int k = kEnds[a][m], l = kEnds[a][1 - m];
          const double at_n = (kNear - kFar) * (onNode(a) + (n == l ? kMore : 0.0));
          total += kFar * (onNode(a) * sum[k] + kMore * r[l][k].v[i]) + at_n * r[n][k].v[i];
        }
        store(dilatation[n][3 * a + i] + lane, total);
      }
    }
  }
}

/// Adds the gradients by all nodes but the corner itself to the rows of the corners' pressures.
inline void addDilatations(const double (*dilatation)[30][kBatchSize],
                           const TetPressures<10>& pressures, int count, double* rows) {
  for (int e = 0; e < count; ++e) {
    for (int n = 0; n < 4; ++n) {
      for (int a = 0; a < 10; ++a) {
        if (a == n) continue;
        const Pair xy = {dilatation[n][3 * a][e], dilatation[n][3 * a + 1][e]};
        addThree(xy, dilatation[n][3 * a + 2][e], rows + pressures.row[9 * n + a - (a > n)][e]);
      }
    }
  }
}

}  // namespace
}  // namespace palpate::fem

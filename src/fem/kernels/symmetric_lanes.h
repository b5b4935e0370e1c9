// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// For kernels only: symmetric tensors of registers, one element per lane.

#include "lane_vectors.h"
#include "tet_batch.h"

namespace palpate::fem {
namespace {

struct Symmetric {
  Lanes xx, yy, zz, xy, yz, zx;
};
inline Symmetric loadSymmetric(const SymmetricBatch& from, int lane) {
  return {load(from.component[0] + lane), load(from.component[1] + lane),
          load(from.component[2] + lane), load(from.component[3] + lane),
          load(from.component[4] + lane), load(from.component[5] + lane)};
}
inline Vec times(const Symmetric& H, const Vec& v) {
  return {{H.xx * v.v[0] + H.xy * v.v[1] + H.zx * v.v[2],
           H.xy * v.v[0] + H.yy * v.v[1] + H.yz * v.v[2],
           H.zx * v.v[0] + H.yz * v.v[1] + H.zz * v.v[2]}};
}
inline Mat times(const Mat& F, const Symmetric& H) {
  Mat P;
  for (int i = 0; i < 3; ++i) {
    const Vec row = times(H, {{F.col[0].v[i], F.col[1].v[i], F.col[2].v[i]}});
    for (int j = 0; j < 3; ++j) P.col[j].v[i] = row.v[j];
  }
  return P;
}
// 1/2 H : (F^T F - I), from F and F H.
inline Lanes viscousEnergy(const Symmetric& H, const Mat& F, const Mat& FH) {
  const Lanes on_C = dot(F.col[0], FH.col[0]) + dot(F.col[1], FH.col[1]) + dot(F.col[2], FH.col[2]);
  return 0.5 * (on_C - (H.xx + H.yy + H.zz));
}

}  // namespace
}  // namespace palpate::fem

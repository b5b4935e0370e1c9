// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// For kernels only: element matrices of linear tetrahedra.

#include "lane_vectors.h"
#include "tet_batch.h"

namespace palpate::fem {
namespace {

// Block of an element's matrix, up to the volume,
//   K_ab = (f g_a . g_b + g_a . H g_b) I + cc c_a c_b^T + fc (f_a c_b^T + c_a f_b^T)
//          + c S(F (g_a x g_b))
// with f_a = F g_a, c_a = cof(F) g_a and S_ik = e_ikm w_m, the second derivative of J.
// `on_identity` is the factor of I.
template <class Point>
inline Mat block(const Point& point, Lanes volume, Lanes on_identity, const Vec& fa, const Vec& ca,
                 const Vec& fb, const Vec& cb) {
  Mat K;
  for (int j = 0; j < 3; ++j) {
    const Lanes on_c = volume * (point.cc * cb.v[j] + point.fc * fb.v[j]);
    const Lanes on_f = volume * (point.fc * cb.v[j]);
    for (int i = 0; i < 3; ++i) K.col[j].v[i] = ca.v[i] * on_c + fa.v[i] * on_f;
    K.col[j].v[j] += volume * on_identity;
  }
  return K;
}

inline void addSpin(Lanes s, const Vec& w, Mat* K) {
  K->col[1].v[0] += s * w.v[2];
  K->col[0].v[1] -= s * w.v[2];
  K->col[0].v[2] += s * w.v[1];
  K->col[2].v[0] -= s * w.v[1];
  K->col[2].v[1] += s * w.v[0];
  K->col[1].v[2] -= s * w.v[0];
}

// Fourth block of a row, by translation invariance: the four blocks sum to zero.
inline Mat minusSum(const Mat& A, const Mat& B, const Mat& C) {
  Mat K;
  for (int j = 0; j < 3; ++j) K.col[j] = negative(A.col[j] + B.col[j] + C.col[j]);
  return K;
}
inline void storeBlock(const Mat& K, double (*out)[kBatchSize], int lane) {
  for (int c = 0; c < 9; ++c) store(out[c] + lane, K.col[c / 3].v[c % 3]);
}

}  // namespace
}  // namespace palpate::fem

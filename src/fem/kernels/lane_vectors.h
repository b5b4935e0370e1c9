// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// For kernels only: vectors and matrices of registers, one element per lane.

#include "palpate/base/lanes.h"

namespace palpate::fem {
namespace {

struct Vec {
  Lanes v[3];
};
inline Vec operator+(const Vec& a, const Vec& b) {
  return {{a.v[0] + b.v[0], a.v[1] + b.v[1], a.v[2] + b.v[2]}};
}
inline Vec negative(const Vec& a) { return {{-a.v[0], -a.v[1], -a.v[2]}}; }
inline Lanes dot(const Vec& a, const Vec& b) {
  return a.v[0] * b.v[0] + a.v[1] * b.v[1] + a.v[2] * b.v[2];
}
inline Vec cross(const Vec& a, const Vec& b) {
  return {{a.v[1] * b.v[2] - a.v[2] * b.v[1], a.v[2] * b.v[0] - a.v[0] * b.v[2],
           a.v[0] * b.v[1] - a.v[1] * b.v[0]}};
}
// Columns.
struct Mat {
  Vec col[3];
};
inline Vec times(const Mat& A, const Vec& x) {
  Vec y;
  for (int i = 0; i < 3; ++i) {
    y.v[i] = A.col[0].v[i] * x.v[0] + A.col[1].v[i] * x.v[1] + A.col[2].v[i] * x.v[2];
  }
  return y;
}
inline Mat cofactor(const Mat& F) {
  return {{cross(F.col[1], F.col[2]), cross(F.col[2], F.col[0]), cross(F.col[0], F.col[1])}};
}
inline Lanes squaredNorm(const Mat& F) {
  return dot(F.col[0], F.col[0]) + dot(F.col[1], F.col[1]) + dot(F.col[2], F.col[2]);
}
inline Mat transposed(const Mat& A) {
  Mat B;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) B.col[j].v[i] = A.col[i].v[j];
  }
  return B;
}

}  // namespace
}  // namespace palpate::fem

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// For kernels only: the matrix of a coarse space.

#include "palpate/base/lanes.h"
#include "pcg_arrays.h"

namespace palpate::solver::PALPATE_ISA {
namespace {

// to[0..kMotions) += s from[0..kMotions)
inline void addScaled(double s, const double* from, double* to) {
  for (int m = 0; m < kMotions; m += kWidth) store(to + m, load(to + m) + s * load(from + m));
}

// Sums by group over the columns of a row: `kRows` times kMotions numbers.
template <int kRows>
class SumsOfGroups {
 public:
  explicit SumsOfGroups(const PcgMotions& P) : P_(P) {}

  void add(int node, const double* motions) {
    for (int q = kGroupsOfANode * node; q < kGroupsOfANode * (node + 1); ++q) {
      if (P_.weight[q] == 0.0) continue;
      double* sum = of(P_.group[q]);
      int k = 0;
      while (k < count_ && P_.reached[k] != P_.group[q]) ++k;
      if (k == count_) {
        P_.reached[count_++] = P_.group[q];
        for (int m = 0; m < kRows * kMotions; ++m) sum[m] = 0.0;
      }
      for (int r = 0; r < kRows; ++r)
        addScaled(P_.weight[q], motions + kMotions * r, sum + kMotions * r);
    }
  }
  double* of(int group) { return P_.sums + 3L * kMotions * group; }
  int count() const { return count_; }
  int group(int k) const { return P_.reached[k]; }

 private:
  const PcgMotions& P_;
  int count_ = 0;
};

inline double* blockOf(const PcgMotions& P, int a, int b, double* C) {
  return C + 6L * kMotions * (static_cast<long>(P.groups) * a + b);
}

void addBlocks(const PcgMotions& P, int i, int count, const int* columns, const double* blocks,
               double* C) {
  SumsOfGroups<3> sums(P);
  for (int k = 0; k < count; ++k) {
    alignas(64) double moved[3 * kMotions] = {};
    for (int c = 0; c < 3; ++c) {
      const double* motion = P.motion + kMotions * (3L * columns[k] + c);
      for (int r = 0; r < 3; ++r) {
        addScaled(blocks[9 * k + 3 * c + r], motion, moved + kMotions * r);
      }
    }
    sums.add(columns[k], moved);
  }
  for (int k = 0; k < sums.count(); ++k) {
    const int b = sums.group(k);
    alignas(64) double forces[6 * kMotions] = {};
    for (int r = 0; r < 3; ++r) {
      const double* motion = P.motion + kMotions * (3L * i + r);
      for (int m = 0; m < 6; ++m) {
        addScaled(motion[m], sums.of(b) + kMotions * r, forces + kMotions * m);
      }
    }
    for (int q = kGroupsOfANode * i; q < kGroupsOfANode * (i + 1); ++q) {
      if (P.weight[q] == 0.0 || P.group[q] > b) continue;
      double* block = blockOf(P, P.group[q], b, C);
      for (int m = 0; m < 6; ++m) {
        addScaled(P.weight[q], forces + kMotions * m, block + kMotions * m);
      }
    }
  }
}

void addSquare(const PcgMotions& P, int count, const int* columns, const double* b, double weight,
               double* C) {
  SumsOfGroups<1> sums(P);
  for (int k = 0; k < count; ++k) {
    alignas(64) double moved[kMotions] = {};
    for (int c = 0; c < 3; ++c) {
      addScaled(b[3 * k + c], P.motion + kMotions * (3L * columns[k] + c), moved);
    }
    sums.add(columns[k], moved);
  }
  for (int k = 0; k < sums.count(); ++k) {
    for (int l = 0; l < sums.count(); ++l) {
      const int a_group = sums.group(k), b_group = sums.group(l);
      if (a_group > b_group) continue;
      double* block = blockOf(P, a_group, b_group, C);
      for (int m = 0; m < 6; ++m) {
        addScaled(weight * sums.of(a_group)[m], sums.of(b_group), block + kMotions * m);
      }
    }
  }
}

}  // namespace
}  // namespace palpate::solver::PALPATE_ISA

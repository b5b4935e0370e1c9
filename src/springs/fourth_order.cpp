// SPDX-License-Identifier: GPL-3.0-or-later
#include "fourth_order.h"

#include <array>
#include <cmath>

namespace palpate::springs {
namespace {

// Calls f(place, i, j, k, l, occurrences) for i <= j <= k <= l.
template <class F>
void forEachComponent(const F& f) {
  int place = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      for (int k = j; k < 3; ++k) {
        for (int l = k; l < 3; ++l) {
          std::array<int, 3> count{};
          for (const int index : {i, j, k, l}) ++count[static_cast<std::size_t>(index)];
          constexpr int kFactorial[] = {1, 1, 2, 6, 24};
          int occurrences = 24;
          for (const int c : count) occurrences /= kFactorial[c];
          f(place++, i, j, k, l, double(occurrences));
        }
      }
    }
  }
}

// Symmetrised d S: six terms.
FourthOrder spread(const Mat3& S) {
  const Mat3 d = Mat3::Identity();
  FourthOrder t;
  forEachComponent([&](int place, int i, int j, int k, int l, double times) {
    t[place] = std::sqrt(times) * (d(i, j) * S(k, l) + d(k, l) * S(i, j) + d(i, k) * S(j, l) +
                                   d(j, l) * S(i, k) + d(i, l) * S(j, k) + d(j, k) * S(i, l));
  });
  return t;
}

// Contraction T_ijkk.
Mat3 contraction(const FourthOrder& t) {
  Mat3 sum = Mat3::Zero();
  const auto component = [&](std::array<int, 4> wanted) {
    std::array<int, 3> count{};
    for (const int index : wanted) ++count[static_cast<std::size_t>(index)];
    double found = 0.0;
    forEachComponent([&](int place, int i, int j, int k, int l, double times) {
      std::array<int, 3> here{};
      for (const int index : {i, j, k, l}) ++here[static_cast<std::size_t>(index)];
      if (here == count) found = t[place] / std::sqrt(times);
    });
    return found;
  };
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) sum(i, j) += component({i, j, k, k});
    }
  }
  return sum;
}

}  // namespace

FourthOrder fourthPower(const Vec3& v) {
  FourthOrder t;
  forEachComponent([&](int place, int i, int j, int k, int l, double times) {
    t[place] = std::sqrt(times) * v[i] * v[j] * v[k] * v[l];
  });
  return t;
}

FourthOrder isotropicFourth() { return 0.5 * spread(Mat3::Identity()); }

FourthOrderParts partsOf(const FourthOrder& tensor) {
  const Mat3 S = contraction(tensor);
  FourthOrderParts parts;
  parts.isotropic = S.trace() / 15.0 * isotropicFourth();
  parts.second = spread(S - S.trace() / 3.0 * Mat3::Identity()) / 7.0;
  parts.rest = tensor - parts.isotropic - parts.second;
  return parts;
}

}  // namespace palpate::springs

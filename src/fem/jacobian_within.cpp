// SPDX-License-Identifier: GPL-3.0-or-later
#include "jacobian_within.h"

#include <Eigen/LU>
#include <algorithm>

#include "shape_functions.h"

namespace palpate::fem {
namespace {

constexpr int kParts = 6;  // subdivisions of an edge

// Change of F [-] up to which det F is at least (1 - kNear)^3 of that at the centre.
constexpr double kNear = 0.2;

bool areNear(const Mat3 (&corners)[4], const Mat3& middle) {
  const double det = middle.determinant();
  if (!(det > 0.0)) return false;
  const Mat3 inverse = middle.inverse();
  return std::all_of(std::begin(corners), std::end(corners), [&](const Mat3& F) {
    return (F * inverse - Mat3::Identity()).squaredNorm() < kNear * kNear;
  });
}

}  // namespace

double jacobianWithin(const Mat3 (&F)[4]) {
  // At point q, w is a for its own corner and b for the others. So the sum of F over the points
  // equals that over the corners.
  const Eigen::Vector4d w = Tetrahedron<10>::point(0);
  const double a = w[0], b = w[1];
  const Mat3 sum = F[0] + F[1] + F[2] + F[3];
  Mat3 corners[4];
  for (int k = 0; k < 4; ++k) corners[k] = (F[k] - b * sum) / (a - b);

  double least = corners[0].determinant();
  for (int k = 1; k < 4; ++k) least = std::min(least, corners[k].determinant());
  if (areNear(corners, 0.25 * sum)) return least;
  for (int i = 0; i <= kParts; ++i) {
    for (int j = 0; i + j <= kParts; ++j) {
      for (int k = 0; i + j + k <= kParts; ++k) {
        const Mat3 at =
            i * corners[0] + j * corners[1] + k * corners[2] + (kParts - i - j - k) * corners[3];
        least = std::min(least, at.determinant() / (kParts * kParts * kParts));
      }
    }
  }
  return least;
}

}  // namespace palpate::fem

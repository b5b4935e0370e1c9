// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/skin/limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::skin {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// Least root > 0 of 1 + a d + b d^2.
double leastRoot(double a, double b) {
  const double square = a * a - 4.0 * b;
  if (square < 0.0) return kNever;
  const double q = -0.5 * (a + std::copysign(std::sqrt(square), a));  // roots are q/b and 1/q
  double least = kNever;
  for (const double root : {b != 0.0 ? q / b : kNever, q != 0.0 ? 1.0 / q : kNever}) {
    if (root > 0.0) least = std::min(least, root);
  }
  return least;
}

}  // namespace

double inversionDepth(const UnitIndentation& unit) {
  double depth = kNever;
  for (std::size_t t = 0; t < unit.mesh.triangles.size(); ++t) {
    const Corners rest = unit.mesh.corners(t);
    Corners moved;
    for (int i = 0; i < 3; ++i) {
      moved.col(i) = unit.displacement.col(unit.mesh.triangles[t][static_cast<std::size_t>(i)]);
    }
    const double area = signedArea(rest), square = signedArea(moved);
    const double linear = signedArea(rest + moved) - area - square;
    depth = std::min(depth, leastRoot(linear / area, square / area));
  }
  return depth;
}

double boneDepth(const UnitIndentation& unit) {
  double depth = kNever;
  for (Eigen::Index i = 0; i < unit.mesh.points.cols(); ++i) {
    const double above = unit.block.height - unit.mesh.points(1, i);
    const double sinks = unit.displacement(1, i);
    if (above > 1e-9 * unit.block.height && sinks > 0.0) depth = std::min(depth, above / sinks);
  }
  return depth;
}

}  // namespace palpate::skin

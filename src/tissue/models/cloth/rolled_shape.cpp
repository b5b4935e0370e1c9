// SPDX-License-Identifier: GPL-3.0-or-later
#include "rolled_shape.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "palpate/base/number.h"

namespace palpate::tissue {
namespace {

constexpr double kPi = 3.14159265358979323846;
// Of the sheet's length: so far may its points be from a plane.
constexpr double kFlat = 1e-6;
constexpr int kHalvings = 100;

// Integral of sqrt(w^2 + c^2) from 0.
double arc(double w, double c) {
  return 0.5 * (w * std::sqrt(w * w + c * c) + c * c * std::asinh(w / c));
}

// How far the outermost turn goes; and all turns.
double angleAt(const RolledSettings& rolled, double left, double length) {
  return rolled.loss > 0.0 ? (1.0 - left) / rolled.loss : length / rolled.radius;
}

bool fits(const RolledSettings& rolled, double length, double spacing) {
  const double narrowest = std::max(spacing, 0.5 * rolled.gap_most);
  const double left = rolled.loss > 0.0 ? narrowest / rolled.radius : 1.0;
  if (narrowest > rolled.radius) return false;
  if (rolled.loss > 0.0) return spiralLength(rolled, left) >= length;
  return length <= 2.0 * kPi * rolled.radius - rolled.gap_least;
}

double leastRadius(RolledSettings rolled, double length, double spacing) {
  double low = 0.0, high = rolled.radius;
  while (rolled.radius = high, !fits(rolled, length, spacing)) high *= 2.0;
  for (int k = 0; k < kHalvings; ++k) {
    rolled.radius = 0.5 * (low + high);
    (fits(rolled, length, spacing) ? high : low) = rolled.radius;
  }
  return high;
}

// To three digits, and not less.
std::string upTo(double value) {
  const double digit = std::pow(10.0, std::floor(std::log10(value)) - 2.0);
  return formatNumber(std::ceil(value / digit) * digit);
}

void checkRolled(const RolledSettings& rolled, double length, double spacing) {
  if (!(rolled.gap_least >= 0.0 && rolled.gap_least < rolled.gap_most)) {
    throw std::invalid_argument("cloth.rolled.gap_least = " + formatNumber(rolled.gap_least) +
                                ": must be less than gap_most, " + formatNumber(rolled.gap_most));
  }
  if (!fits(rolled, length, spacing)) {
    throw std::invalid_argument(
        "cloth.rolled.radius = " + formatNumber(rolled.radius) + ": a sheet of the length " +
        formatNumber(length) + " m with points " + upTo(spacing) + " m apart needs " +
        upTo(leastRadius(rolled, length, spacing)) + " m or more with this loss");
  }
  const double left = spiralLeft(rolled, length);
  if (angleAt(rolled, left, length) <= 2.0 * kPi) return;
  const double turn = 2.0 * kPi * rolled.loss * rolled.radius;
  if (turn > rolled.gap_least) return;
  throw std::invalid_argument("cloth.rolled.loss = " + formatNumber(rolled.loss) +
                              ": layers would be " + formatNumber(turn) +
                              " m apart, no more than gap_least; must be above " +
                              upTo(rolled.gap_least / (2.0 * kPi * rolled.radius)));
}

}  // namespace

double spiralLength(const RolledSettings& rolled, double left) {
  const double c = rolled.loss;
  return rolled.radius / c * (arc(1.0, c) - arc(left, c));
}

double spiralLeft(const RolledSettings& rolled, double length) {
  if (rolled.loss == 0.0) return 1.0;
  double low = 0.0, high = 1.0;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (spiralLength(rolled, middle) > length ? low : high) = middle;
  }
  return high;
}

Points rolledUp(const Points& X, double spacing, const RolledSettings& rolled) {
  const Vec3 low = X.rowwise().minCoeff(), high = X.rowwise().maxCoeff();
  const double length = high.y() - low.y();
  if (high.z() - low.z() > kFlat * length) {
    throw std::invalid_argument("cloth.rolled: needs a sheet at one z; this one reaches from " +
                                formatNumber(low.z()) + " to " + formatNumber(high.z()) + " m");
  }
  checkRolled(rolled, length, spacing);
  Points x = X;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    const double along = X(1, i) - low.y(), left = spiralLeft(rolled, along);
    const double angle = angleAt(rolled, left, along), r = rolled.radius * left;
    x(1, i) = low.y() + r * std::sin(angle);
    x(2, i) = X(2, i) + rolled.radius - r * std::cos(angle);
  }
  return x;
}

}  // namespace palpate::tissue

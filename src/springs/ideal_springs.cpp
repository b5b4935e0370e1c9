// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/ideal_springs.h"

#include <algorithm>
#include <cmath>

namespace palpate::springs {
namespace {

// 1 - sin(x)/x and its derivative, without cancellation.
double sincLoss(double x) {
  const double y = x * x;
  if (y < 1e-2) return y / 6.0 * (1.0 - y / 20.0 * (1.0 - y / 42.0 * (1.0 - y / 72.0)));
  return 1.0 - std::sin(x) / x;
}
double sincLossSlope(double x) {
  const double y = x * x;
  if (y < 1e-2) return x / 3.0 * (1.0 - y / 10.0 * (1.0 - y / 28.0 * (1.0 - y / 54.0)));
  return (std::sin(x) - x * std::cos(x)) / y;
}

// Point of a curve at theta = U rho / 2, forces over the limit's force and lengths over U. The line
// with slope s has the force 1 + s stretch.
struct CurvePoint {
  double stretch;
  double force;
  double width;  // d stretch / d theta
};

CurvePoint structuralPoint(double theta) {
  const double sinc = 1.0 - sincLoss(theta);
  return {-sincLoss(theta), std::cos(theta) / (sinc * sinc), sincLossSlope(theta)};
}

// The stretch is 2 - v/U: a flexion spring pushes more when shortened.
CurvePoint flexionPoint(double theta) {
  const double sinc = 1.0 - sincLoss(theta);
  return {2.0 * sincLoss(2.0 * theta), 1.0 / (sinc * sinc), 4.0 * sincLossSlope(2.0 * theta)};
}

// Integral of f over the curve from 0 to theta, by five-point Gauss rules on 32 parts.
template <class F>
double integrate(CurvePoint (*curve)(double), double theta, const F& f) {
  constexpr int kParts = 32;
  constexpr double kX[] = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                           0.9061798459386640};
  constexpr double kW[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                           0.4786286704993665, 0.2369268850561891};
  double sum = 0.0;
  for (int part = 0; part < kParts; ++part) {
    for (int k = 0; k < 5; ++k) {
      const CurvePoint point = curve(theta * (part + 0.5 + 0.5 * kX[k]) / kParts);
      sum += 0.5 * kW[k] * theta / kParts * point.width * f(point);
    }
  }
  return sum;
}

double squareError(CurvePoint (*curve)(double), double theta, double slope) {
  return integrate(curve, theta, [&](const CurvePoint& p) {
    const double error = 1.0 + slope * p.stretch - p.force;
    return error * error;
  });
}

double bestSlope(CurvePoint (*curve)(double), double theta) {
  return integrate(curve, theta, [](const CurvePoint& p) { return (p.force - 1.0) * p.stretch; }) /
         integrate(curve, theta, [](const CurvePoint& p) { return p.stretch * p.stretch; });
}

}  // namespace

IdealSprings IdealSprings::ofBeam(const BeamSection& beam, double spacing) {
  check(beam);
  requirePositive("spacing", spacing);
  return {beam.young_modulus * beam.second_moment, spacing};
}

IdealSprings IdealSprings::ofTriangles(const Sheet& sheet, double spacing) {
  check(sheet);
  requirePositive("spacing", spacing);
  return {(1.0 + sheet.poisson_ratio) * sheet.bendingStiffness() * spacing / std::sqrt(3.0),
          spacing};
}

double IdealSprings::structuralSpacing(double rho) const {
  return U_ * (1.0 - sincLoss(0.5 * U_ * rho));
}

double IdealSprings::structuralForce(double rho) const {
  return structuralLimit().force * structuralPoint(0.5 * U_ * rho).force;
}

double IdealSprings::flexionSpacing(double rho) const {
  return 2.0 * U_ * (1.0 - sincLoss(U_ * rho));
}

double IdealSprings::flexionForce(double rho) const {
  return flexionLimit().force * flexionPoint(0.5 * U_ * rho).force;
}

ForceLine IdealSprings::structuralLimit() const {
  return {U_, 4.0 * B_ / (U_ * U_), 4.0 * B_ / (U_ * U_ * U_)};
}

ForceLine IdealSprings::flexionLimit() const {
  return {2.0 * U_, -2.0 * B_ / (U_ * U_), 0.5 * B_ / (U_ * U_ * U_)};
}

double IdealSprings::structuralError(double rest_length, double rho_max) const {
  const double force = structuralLimit().force;
  return force * force * U_ *
         squareError(structuralPoint, 0.5 * U_ * rho_max, U_ / (U_ - rest_length));
}

double IdealSprings::flexionError(double rest_length, double rho_max) const {
  const double force = flexionLimit().force;
  return force * force * U_ *
         squareError(flexionPoint, 0.5 * U_ * rho_max, U_ / (rest_length - 2.0 * U_));
}

double IdealSprings::structuralRestLength(double rho_max) const {
  return U_ * (1.0 - 1.0 / std::max(1.0, bestSlope(structuralPoint, 0.5 * U_ * rho_max)));
}

double IdealSprings::flexionRestLength(double rho_max) const {
  return U_ * (2.0 + 1.0 / bestSlope(flexionPoint, 0.5 * U_ * rho_max));
}

}  // namespace palpate::springs

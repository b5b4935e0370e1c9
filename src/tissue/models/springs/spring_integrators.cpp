// SPDX-License-Identifier: GPL-3.0-or-later
#include "spring_integrators.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/base/error.h"

namespace palpate::tissue {
namespace {

Vec3 goForward(double h, const Vec3& a, Vec3* v) {
  const Vec3 way = h * *v;
  *v += h * a;
  return way;
}

Vec3 goTrapezoidally(double h, const Vec3& a, Vec3* v) {
  const Vec3 way = h * *v + 0.5 * h * h * a;
  *v += h * a;
  return way;
}

Vec3 goSymplectically(double h, const Vec3& a, Vec3* v) {
  *v += h * a;
  return h * *v;
}

// Of the map of (x, h v) the determinant must not exceed 1, nor 1 + trace + determinant fall below
// zero [Jury 1964]. With s = w2 h^2 and e = d h they are
// forward Euler: 1 - e + s and 4 - 2 e + s,
double longestForward(double w2, double d, double d_most) { return std::min(d / w2, 2.0 / d_most); }

// trapezoidal: 1 - e + s/2 and 4 - 2 e,
double longestTrapezoidal(double w2, double d, double d_most) {
  return std::min(2.0 * d / w2, 2.0 / d_most);
}

// symplectic: 1 - e and 4 - 2 e - s.
double longestSymplectic(double w2, double, double d_most) {
  return (std::sqrt(d_most * d_most + 4.0 * w2) - d_most) / w2;
}

}  // namespace

const std::vector<SpringIntegrator>& springIntegrators() {
  static const std::vector<SpringIntegrator> kAll = {
      {"symplectic_euler", goSymplectically, longestSymplectic},
      {"trapezoidal_euler", goTrapezoidally, longestTrapezoidal},
      {"forward_euler", goForward, longestForward},
  };
  return kAll;
}

const SpringIntegrator& springIntegrator(const std::string& name) {
  std::vector<std::string> names;
  for (const SpringIntegrator& integrator : springIntegrators()) {
    if (name == integrator.name) return integrator;
    names.emplace_back(integrator.name);
  }
  throw std::invalid_argument("springs.scheme = " + name + ": must be one of " + joinNames(names));
}

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
// Explicit steps of springs against the exact motion of a damped oscillator: their order and the
// longest step that is stable.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tissue/models/springs/spring_integrators.h"

namespace palpate::tissue::spring_integrators_test {
namespace {

constexpr double kSquare = 400.0, kDamping = 6.0;  // w^2, d: x'' + d x' + w^2 x = 0

struct Oscillator {
  double x = 1.0, v = 0.0;
  void step(const SpringIntegrator& integrator, double h, double w2, double d) {
    Vec3 velocity(v, 0.0, 0.0);
    x += integrator.go(h, Vec3(-w2 * x - d * v, 0.0, 0.0), &velocity).x();
    v = velocity.x();
  }
};

double exact(double t) {
  const double decay = 0.5 * kDamping, w = std::sqrt(kSquare - decay * decay);
  return std::exp(-decay * t) * (std::cos(w * t) + decay / w * std::sin(w * t));
}

class Integrators : public ::testing::TestWithParam<SpringIntegrator> {};
INSTANTIATE_TEST_SUITE_P(All, Integrators, ::testing::ValuesIn(springIntegrators()),
                         [](const auto& of) { return std::string(of.param.name); });

double errorAt(const SpringIntegrator& integrator, int steps) {
  Oscillator oscillator;
  for (int k = 0; k < steps; ++k) oscillator.step(integrator, 0.5 / steps, kSquare, kDamping);
  return std::abs(oscillator.x - exact(0.5));
}

// Half the step, half the error.
TEST_P(Integrators, AreOfFirstOrder) {
  const double slope = std::log2(errorAt(GetParam(), 8000) / errorAt(GetParam(), 16000));
  RecordProperty("order", std::to_string(slope));
  EXPECT_NEAR(slope, 1.0, 0.05);
}

// Whether the amplitude grows just below and above the limit of a mode that is not damped so much
// that it stops swinging.
TEST_P(Integrators, AreStableUpToTheLimit) {
  for (const double d : {0.5, 6.0, 19.0}) {
    const double limit = GetParam().longest(kSquare, d, d);
    ASSERT_GT(limit, 0.0);
    for (const double part : {0.98, 1.02}) {
      Oscillator oscillator;
      double half = 0.0, amplitude = 0.0;
      for (int k = 0; k < 200000 && amplitude < 1e3; ++k) {
        oscillator.step(GetParam(), part * limit, kSquare, d);
        const double now = std::hypot(oscillator.x, oscillator.v / std::sqrt(kSquare));
        amplitude = k % 1000 < 100 ? std::max(k % 1000 == 0 ? 0.0 : amplitude, now) : amplitude;
        if (k == 100099) half = amplitude;
      }
      EXPECT_EQ(amplitude > std::max(half, 1e-200), part > 1.0) << d << " " << part;
    }
  }
}

TEST(Integrator, WithoutDampingOnlySymplecticEulerIsStable) {
  for (const SpringIntegrator& integrator : springIntegrators()) {
    const double limit = integrator.longest(kSquare, 0.0, 0.0);
    if (std::string(integrator.name) == "symplectic_euler") {
      EXPECT_DOUBLE_EQ(limit, 2.0 / std::sqrt(kSquare));
    } else {
      EXPECT_EQ(limit, 0.0);
    }
  }
  EXPECT_THROW(springIntegrator("euler"), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::tissue::spring_integrators_test

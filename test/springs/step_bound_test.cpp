// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/step_bound.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "palpate/springs/network_statics.h"
#include "palpate/springs/spring_grids.h"

namespace palpate::springs::step_bound_test {
namespace {

// Largest modulus of an eigenvalue of one step, of a network whose stiffnesses are their bounds.
double growth(SpringNetwork network, double step, ExplicitRule rule, double drag, double share) {
  const Eigen::VectorXd bound = largestStiffness(network.springs, network.masses, step, rule, drag);
  for (std::size_t i = 0; i < network.springs.size(); ++i) {
    network.springs[i].stiffness = share * bound[static_cast<Eigen::Index>(i)];
    network.springs[i].preload = 0.0;
  }
  const Eigen::MatrixXd K = networkTangent(network, network.points);
  const Eigen::Index n = K.rows();
  Eigen::MatrixXd M_inverse = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) M_inverse(i, i) = 1.0 / network.masses[i / 3];
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd kick = -step * M_inverse * K, keep = (1.0 - step * drag) * I;
  Eigen::MatrixXd A(2 * n, 2 * n);  // of (x, v)
  if (rule == ExplicitRule::kForwardEuler) {
    A << I, step * I, kick, keep;
  } else {
    A << I + step * kick, step * keep, kick, keep;
  }
  return A.eigenvalues().cwiseAbs().maxCoeff();
}

SpringNetwork block() { return cubeNetwork({1.0, 1.0, 1.0}, 0.1, {1, 2, 1}, 1000.0); }

// Rigid motions give 1, twice, which the eigenvalues of a defective matrix miss by 1e-8.
TEST(StepBound, StepsWithTheLargestStiffnessAreStable) {
  constexpr double kRoot = 1.0 + 1e-7;
  for (const double drag : {0.0, 30.0}) {
    EXPECT_LT(growth(block(), 1e-3, ExplicitRule::kSymplecticEuler, drag, 0.9999), kRoot);
  }
  for (const double drag : {1.0, 30.0, 900.0}) {
    EXPECT_LT(growth(block(), 1e-3, ExplicitRule::kForwardEuler, drag, 0.9999), kRoot);
  }
}

TEST(StepBound, OneSpringIsAtItsBound) {
  const SpringNetwork pair = lineNetwork({{0.0, 1.0}, {0.0, 0.0}}, 0.1, 2, 3.0);
  EXPECT_LT(growth(pair, 1e-3, ExplicitRule::kSymplecticEuler, 5.0, 0.999), 1.0 + 1e-7);
  EXPECT_GT(growth(pair, 1e-3, ExplicitRule::kSymplecticEuler, 5.0, 1.001), 1.01);
  EXPECT_LT(growth(pair, 1e-3, ExplicitRule::kForwardEuler, 5.0, 0.999), 1.0 + 1e-7);
  EXPECT_GT(growth(pair, 1e-3, ExplicitRule::kForwardEuler, 5.0, 1.001), 1.0 + 1e-6);
  const double mass = pair.masses[0];
  EXPECT_NEAR(largestStiffness(pair.springs, pair.masses, 1e-3)[0], 4e6 * mass / 2, 1e-6 * mass);
}

TEST(StepBound, TheLargestStepIsTheOneOfWhichTheStiffnessIsTheBound) {
  SpringNetwork network = block();
  const double step = largestStep(network);
  const Eigen::VectorXd bound = largestStiffness(network.springs, network.masses, step);
  double share = 0.0;
  for (std::size_t i = 0; i < network.springs.size(); ++i) {
    share = std::max(share, network.springs[i].stiffness / bound[static_cast<Eigen::Index>(i)]);
  }
  EXPECT_NEAR(share, 1.0, 1e-12);
}

TEST(StepBound, RefusesStepsAndDragsThatCannotBe) {
  const SpringNetwork pair = lineNetwork({{0.0, 1.0}, {0.0, 0.0}}, 0.1, 2, 3.0);
  const auto bound = [&](double step, ExplicitRule rule, double drag) {
    return largestStiffness(pair.springs, pair.masses, step, rule, drag);
  };
  EXPECT_THROW(bound(0.0, ExplicitRule::kSymplecticEuler, 0.0), std::invalid_argument);
  EXPECT_THROW(bound(1e-3, ExplicitRule::kForwardEuler, 0.0), std::invalid_argument);
  EXPECT_THROW(bound(1e-3, ExplicitRule::kSymplecticEuler, 2e3), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::springs::step_bound_test

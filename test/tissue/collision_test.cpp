// SPDX-License-Identifier: GPL-3.0-or-later
// Two free organs that collide: what one loses the other one gets.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "two_organs.h"

namespace palpate::tissue::collision_test {
namespace {

using test::makeOrgans;
using test::OrganSketch;

// Blocks of 30 x 30 x 20 mm in the air, towards each other at 0.4 m/s, with a lateral offset of 8
// mm between their centres, which makes them spin. No damping.
struct Collision {
  explicit Collision(const std::string& integrator = "backward_euler") {
    const auto none = [](const Vec3&) { return false; };
    const Vec3 size(0.03, 0.03, 0.02);
    organs = {test::block("left", Vec3::Zero(), size, {3, 3, 2}, none),
              test::block("right", Vec3(0.04, 0.008, 0.002), size, {3, 3, 2}, none)};
    for (OrganSketch& organ : organs) organ.damping = {};
    ModelSettings settings = test::organSettings();
    settings.gravity.setZero();
    settings.integrator = integrator;
    settings.tolerance = 1e-10;
    settings.position_tolerance = 0.0;
    settings.skip.sleeping = false;
    tissue = makeOrgans(organs, settings);
    for (int k = 0; k < 2; ++k) {
      const OrganSketch& organ = organs[static_cast<std::size_t>(k)];
      masses.push_back(
          fem::makeElasticity(organ.element, organ.mesh, fem::Composition{{organ.solid}, {}, {}})
              ->masses());
      Points v = Points::Zero(3, organ.mesh.numPoints());
      v.row(0).setConstant(k == 0 ? 0.4 : -0.4);
      tissue->setPositions(k, organ.mesh.points, v);
    }
  }
  Vec3 momentum(int k) const { return tissue->velocities(k) * masses[static_cast<std::size_t>(k)]; }
  // sum m a x b
  Vec3 moment(int k, const Points& a, const Points& b) const {
    Vec3 sum = Vec3::Zero();
    const Eigen::VectorXd& m = masses[static_cast<std::size_t>(k)];
    for (Eigen::Index i = 0; i < a.cols(); ++i) {
      sum += m[i] * Vec3(a.col(i)).cross(Vec3(b.col(i)));
    }
    return sum;
  }
  Vec3 spin(int k) const { return moment(k, tissue->positions(k), tissue->velocities(k)); }

  std::vector<OrganSketch> organs;
  std::unique_ptr<TissueModel> tissue;
  std::vector<Eigen::VectorXd> masses;
};

// What is unbalanced, below 1e-12 N, adds 2e-15 N s at most in each of 100 cycles; 1e-2 N s are
// exchanged. Of the angular momentum L = sum m x (x) v backward Euler changes by itself
// L_(n+1) - L_n = h sum m v_(n+1) (x) v_n + h sum x_(n+1) (x) f, of which the second sum is zero
// where no torque acts from outside.
TEST(Collision, ConservesMomentum) {
  Collision collision;
  constexpr double kStep = 0.002;
  const Vec3 before = collision.momentum(0) + collision.momentum(1);
  const Vec3 left_before = collision.momentum(0);
  const Vec3 spin_before = collision.spin(0);
  double error = 0.0, spin_error = 0.0, most = 0.0, spun = 0.0;
  for (int k = 0; k < 100; ++k) {
    Vec3 spin = Vec3::Zero();
    const Points v[] = {collision.tissue->velocities(0), collision.tissue->velocities(1)};
    for (int organ = 0; organ < 2; ++organ) spin -= collision.spin(organ);
    const TissueStep& step = collision.tissue->step({}, kStep);
    ASSERT_TRUE(step.ok()) << solver::toString(step.status);
    for (int organ = 0; organ < 2; ++organ) {
      spin += collision.spin(organ);
      spin -= kStep * collision.moment(organ, collision.tissue->velocities(organ), v[organ]);
    }
    const Vec3 now = collision.momentum(0) + collision.momentum(1);
    error = std::max(error, (now - before).norm());
    spin_error = std::max(spin_error, spin.norm());
    most = std::max(most, (collision.momentum(0) - left_before).norm());
    spun = std::max(spun, (collision.spin(0) - spin_before).norm());
  }
  std::printf("momentum %.2e of %.3e N s, angular in a cycle %.2e of %.3e N m s\n", error, most,
              spin_error, spun);
  EXPECT_GT(most, 0.2 * left_before.norm());  // they did collide
  EXPECT_LE(error, 1e-10 * most);
  EXPECT_LE(spin_error, 1e-10 * spun);
}

// Its own change of the angular momentum is of first order in the step.
TEST(Collision, KeepsAngularMomentumToFirstOrder) {
  const auto lost = [](double step) {
    Collision collision;
    const Vec3 before = collision.spin(0) + collision.spin(1);
    for (int k = 0; k < std::lround(0.1 / step); ++k) collision.tissue->step({}, step);
    return (collision.spin(0) + collision.spin(1) - before).norm();
  };
  const double coarse = lost(0.002), fine = lost(0.001), finest = lost(0.0005);
  std::printf("lost %.3e, %.3e, %.3e N m s\n", coarse, fine, finest);
  EXPECT_LE(fine, 0.7 * coarse);
  EXPECT_LE(finest, 0.7 * fine);
}

}  // namespace
}  // namespace palpate::tissue::collision_test

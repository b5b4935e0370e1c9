// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/rigid_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "palpate/contact/signed_distance.h"
#include "palpate/mesh/size_field.h"
#include "sampled_surfaces.h"
#include "test_shapes.h"

namespace palpate::contact::rigid_contact_test {
namespace {

using instrument::Geometry;

constexpr double kStiffness = 2.0e4;  // [N/m]

std::vector<std::pair<std::string, Geometry>> toolShapes() {
  auto shapes = testShapes();
  shapes.emplace_back("hook", sampled(test::hookSurface()));
  return shapes;
}

TEST(TouchBalls, TouchTheSurfaceFromInsideEverywhere) {
  std::mt19937 rng{1};
  for (const auto& [name, geometry] : toolShapes()) {
    const std::vector<TouchBall> balls = touchBalls(geometry);
    for (const TouchBall& ball : balls) {
      EXPECT_NEAR(signedDistanceValue(geometry, ball.center_G), -ball.radius,
                  1e-12 + distanceError(geometry))
          << name;
    }
    // From each side of the shape some ball is seen about where the surface is.
    const double size = 2.0 * boundingRadius(geometry);
    for (int n = 0; n < 200; ++n) {
      const Vec3 p = randomPoints(&rng, 1, size).col(0);
      // Far from a sampled surface only a bound is known.
      const auto* sampled = std::get_if<instrument::SampledSurface>(&geometry);
      const double distance = sampled ? mesh::SurfaceDistance(sampled->grid->surface)(p)
                                      : signedDistanceValue(geometry, p);
      if (distance < 0.5 * size) continue;
      double nearest = 1e9;
      for (const TouchBall& ball : balls) {
        nearest = std::min(nearest, (p - ball.center_G).norm() - ball.radius);
      }
      // Points aside of the foot by all of the spacing are farther by spacing^2 / (2 distance).
      const double spacing = kBallSpacing * size;
      EXPECT_LT(nearest - distance, spacing * spacing / distance + distanceError(geometry)) << name;
    }
  }
}

TEST(RigidContact, OfABallOnAPlaneIsASpring) {
  const Geometry plate = hullOfBox(Vec3(0.05, 0.05, 0.01), Vec3::Zero());
  const Geometry ball = instrument::Sphere{0.005};
  RigidContact contact(&plate, Pose(Eigen::Translation3d(0.1, 0.2, 0.3)), kStiffness);
  for (const double depth : {1e-9, 1e-4, 1e-3, 4e-3}) {
    contact.clear();
    const Vec3 center(0.11, 0.19, 0.31 + 0.005 - depth);
    ASSERT_TRUE(contact.add(touchBalls(ball), 0.005, Pose(Eigen::Translation3d(center))));
    EXPECT_NEAR(contact.solve(), 0.5 * kStiffness * depth * depth, 1e-12 * depth);
    ASSERT_EQ(contact.touches().size(), 1u);
    const RigidTouch& touch = contact.touches()[0];
    EXPECT_NEAR(touch.depth, depth, 1e-15);
    EXPECT_LT((touch.force_W - kStiffness * depth * Vec3::UnitZ()).norm(), 1e-10);
    EXPECT_LT((touch.p_W - Vec3(0.11, 0.19, 0.31 - depth)).norm(), 1e-12);
  }
  contact.clear();
  EXPECT_EQ(contact.solve(), 0.0);
}

TEST(RigidContact, OfManyPointsIsHardlyStifferThanOfOne) {
  const Geometry plate = instrument::Box{Vec3(0.05, 0.05, 0.01)};
  const Geometry box = instrument::Box{Vec3(0.01, 0.01, 0.01)};
  RigidContact contact(&plate, Pose::Identity(), kStiffness);
  contact.add(touchBalls(box), boundingRadius(box), Pose(Eigen::Translation3d(0, 0, 0.0195)));
  contact.solve();
  Vec3 force = Vec3::Zero();
  for (const RigidTouch& touch : contact.touches()) force += touch.force_W;
  const double n = static_cast<double>(contact.touches().size());
  EXPECT_GT(n, 100.0);
  EXPECT_LT((force - std::pow(n, 2.0 / kDepthPower) * kStiffness * 0.5e-3 * Vec3::UnitZ()).norm(),
            1e-9);
  EXPECT_LT(force.z(), 6.0 * kStiffness * 0.5e-3);
}

TEST(RigidContact, LooksAtNothingThatIsFar) {
  const Geometry bone = sampled(test::hookSurface());
  const Geometry ball = instrument::Sphere{0.002};
  RigidContact contact(&bone, Pose::Identity(), kStiffness);
  const auto at = [](double x) { return Pose(Eigen::Translation3d(x, 0.002, 0.010)); };
  EXPECT_FALSE(contact.add(touchBalls(ball), 0.002, at(-0.01)));
  EXPECT_FALSE(contact.wouldTouch(touchBalls(ball), 0.002, at(-0.01)));
  EXPECT_TRUE(contact.add(touchBalls(ball), 0.002, at(-0.001)));
  EXPECT_TRUE(contact.wouldTouch(touchBalls(ball), 0.002, at(-0.001)));
  // Hung up in the hook it touches nothing, though it is within the hull.
  EXPECT_FALSE(contact.wouldTouch(touchBalls(ball), 0.002, at(0.010)));
}

struct Felt {
  double energy;
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();  // about the tool's origin
};

Felt feel(RigidContact* contact, const std::vector<TouchBall>& balls, const Pose& X_WT) {
  contact->clear();
  contact->add(balls, 1.0, X_WT);
  Felt felt{contact->solve()};
  for (const RigidTouch& touch : contact->touches()) {
    felt.force += touch.force_W;
    felt.torque += (touch.p_W - X_WT.translation()).cross(touch.force_W);
  }
  return felt;
}

Pose movedBy(const Pose& X, const Vec3& shift, const Vec3& turn) {
  Pose moved = X;
  if (turn.norm() > 0.0) {
    moved.linear() =
        Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * X.linear();
  }
  moved.translation() += shift;
  return moved;
}

// On bone that is sampled: its distance is smooth.
TEST(RigidContact, WrenchIsTheSlopeOfTheEnergy) {
  const Geometry bone = sampled(test::uSurface(), {64, 1e-4, 64.0, 0.006});
  std::mt19937 rng{2};
  for (const auto& [name, geometry] : toolShapes()) {
    const std::vector<TouchBall> balls = touchBalls(geometry);
    const Pose X_WG = randomPose(&rng, 0.1);
    const Vec3 middle = test::uSurface().points.rowwise().mean();
    RigidContact contact(&bone, X_WG, kStiffness);
    int checked = 0;
    for (int n = 0; n < 4000 && checked < 50; ++n) {
      const Pose X = X_WG * Eigen::Translation3d(middle) * randomPose(&rng, 0.02);
      const Felt at = feel(&contact, balls, X);
      if (at.energy < 1e-8 || at.energy > 0.1) continue;
      ++checked;
      constexpr double h = 1e-8;
      for (int k = 0; k < 3; ++k) {
        const auto slope = [&](const Vec3& shift, const Vec3& turn) {
          const double plus = feel(&contact, balls, movedBy(X, shift, turn)).energy;
          return (plus - feel(&contact, balls, movedBy(X, -shift, -turn)).energy) / (2.0 * h);
        };
        const double tolerance = 1e-4 * at.force.norm() + 1e-5;
        EXPECT_NEAR(at.force[k], -slope(h * Vec3::Unit(k), Vec3::Zero()), tolerance) << name;
        EXPECT_NEAR(at.torque[k], -slope(Vec3::Zero(), h * Vec3::Unit(k)), 0.03 * tolerance)
            << name;
      }
    }
    EXPECT_GE(checked, 20) << name;
  }
}

// In at one place, along and turning, out at another, and back aside: what goes in comes out, but
// for the error of the sum over steps, which goes with their square.
TEST(RigidContact, OnAClosedWayDoesNoWork) {
  const Geometry bone = sampled(test::hookSurface());
  const Geometry tool = instrument::Cylinder{0.003, 0.006};
  const std::vector<TouchBall> balls = touchBalls(tool);
  RigidContact contact(&bone, Pose::Identity(), kStiffness);
  const auto pose = [](double s) {
    const double a = 2.0 * EIGEN_PI * s;
    const Pose X(Eigen::Translation3d(0.010 + 0.006 * std::cos(a),
                                      0.002 + 0.002 * std::sin(2.0 * a),
                                      0.025 + 0.004 * std::sin(a)));
    return movedBy(X, Vec3::Zero(), 0.5 * std::sin(a) * Vec3(1.0, 1.0, 0.3));
  };
  const auto work = [&](int steps, double* in) {
    double sum = 0.0;
    *in = 0.0;
    Felt last = feel(&contact, balls, pose(0.0));
    for (int n = 1; n <= steps; ++n) {
      const Pose from = pose(static_cast<double>(n - 1) / steps),
                 to = pose(static_cast<double>(n) / steps);
      const Eigen::AngleAxisd turn(Mat3(to.linear() * from.linear().transpose()));
      const Felt now = feel(&contact, balls, to);
      const double done =
          0.5 * (last.force + now.force).dot(to.translation() - from.translation()) +
          0.5 * (last.torque + now.torque).dot(turn.angle() * turn.axis());
      sum += done;
      *in += std::max(0.0, -done);
      last = now;
    }
    return sum;
  };
  double in = 0.0;
  const double coarse = std::abs(work(2000, &in)), fine = std::abs(work(4000, &in));
  EXPECT_GT(in, 1e-3);
  EXPECT_LT(fine, 1e-3 * in);
  EXPECT_LT(fine, 0.5 * coarse + 1e-9);
  std::cout << "of " << in << " J that go in " << fine << " J do not come out in 4000 steps, "
            << coarse << " J in 2000\n";
}

// Along the top of the hook and over its end: the stiffness of the points together is bounded, and
// so is what the bone's curvature adds, a depth of 1 mm over cells of 0.4 mm.
TEST(RigidContact, ForceHasNoJumpsWhileAToolSlides) {
  const Geometry bone = sampled(test::hookSurface(), {64, 1e-4, 64.0, 0.006});
  for (const auto& [name, geometry] : toolShapes()) {
    const std::vector<TouchBall> balls = touchBalls(geometry);
    RigidContact contact(&bone, Pose::Identity(), kStiffness);
    // A millimetre or so deep; the hook's origin is a corner of it.
    const double height = name == "hook" ? 0.0195 : 0.019 + inscribedRadius(geometry);
    constexpr double kStep = 1e-5;
    Felt last{0.0};
    double largest = 0.0;
    for (int n = 0; n <= 3000; ++n) {
      const Pose X = movedBy(Pose(Eigen::Translation3d(-0.005 + n * kStep, 0.002, height)),
                             Vec3::Zero(), Vec3(0.1, 0.2, 0.3));
      const Felt now = feel(&contact, balls, X);
      if (n > 0) largest = std::max(largest, (now.force - last.force).norm());
      last = now;
    }
    EXPECT_GT(largest, 0.0) << name;
    EXPECT_LT(largest, 15.0 * kStiffness * kStep) << name;
    std::cout << name << ": " << largest / (kStiffness * kStep) << " times the spring's\n";
  }
}

}  // namespace
}  // namespace palpate::contact::rigid_contact_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/touch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpate/contact/signed_distance.h"
#include "test_shapes.h"

namespace palpate::contact::touch_test {
namespace {

Touch measure(const Obstacle& obstacle, const Vec3& p_begin_W, const Vec3& p_W) {
  Touch touch;
  const PosedObstacle posed(obstacle);
  posed.measureGap(p_W, &touch);
  posed.measureFrame(&touch);
  posed.measureMotion(p_begin_W, &touch);
  return touch;
}

Pose turned(double angle, const Vec3& axis, const Vec3& position) {
  Pose X = Pose::Identity();
  X.linear() = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  X.translation() = position;
  return X;
}

TEST(Touch, TangentsAndNormalAreARightHandedFrame) {
  std::mt19937 rng{1};
  const Points random = randomPoints(&rng, 200, 1.0);
  for (Eigen::Index i = -6; i < random.cols(); ++i) {
    const Vec3 n = i >= 0 ? Vec3(random.col(i).normalized())
                          : Vec3((i % 2 == 0 ? 1.0 : -1.0) * Vec3::Unit((i + 6) / 2));
    const Eigen::Matrix<double, 3, 2> t = tangents(n);
    EXPECT_LT((t.transpose() * t - Eigen::Matrix2d::Identity()).norm(), 1e-15);
    EXPECT_LT((t.col(0).cross(t.col(1)) - n).norm(), 1e-15);
  }
}

TEST(Touch, HasGapFrameAndCurvatureOfTheDistance) {
  std::mt19937 rng{2};
  for (const auto& [name, geometry] : testShapes()) {
    const Obstacle obstacle{&geometry, 3, randomPose(&rng, 0.01), randomPose(&rng, 0.01), 7};
    for (int k = 0; k < 20; ++k) {
      const Vec3 p_W = obstacle.X_WG_end * Vec3(randomPoints(&rng, 1, 0.01).col(0));
      const Touch touch = measure(obstacle, p_W, p_W);
      const Distance d = signedDistance(geometry, obstacle.X_WG_end.inverse() * p_W);
      EXPECT_EQ(touch.gap, d.value) << name;
      EXPECT_EQ(touch.number, 7);
      EXPECT_EQ(touch.radius, inscribedRadius(geometry)) << name;
      EXPECT_LT((touch.R_WG * touch.normal_G - touch.normal_W).norm(), 1e-15) << name;
      EXPECT_LT((touch.normal_G - d.normal_G).norm(), 1e-15) << name;
      EXPECT_EQ(touch.curvature_G, d.hessian_G) << name;
      EXPECT_EQ(PosedObstacle(obstacle).gap(p_W), touch.gap) << name;
    }
  }
}

// In the middle of a sheet: nearer to the shape by half of the thickness on either side, along the
// same normal, and with so much more room to the shape's middle.
TEST(Touch, IsNearerByTheMarginOfASheet) {
  std::mt19937 rng{5};
  constexpr double kMargin = 0.003;
  for (const auto& [name, geometry] : testShapes()) {
    const Obstacle obstacle{&geometry, 0, randomPose(&rng, 0.01), randomPose(&rng, 0.01)};
    const PosedObstacle thin(obstacle), thick(obstacle, kMargin);
    EXPECT_EQ(thick.radius(), thin.radius() + kMargin) << name;
    const Vec3 p_W = obstacle.X_WG_end * Vec3(randomPoints(&rng, 1, 0.01).col(0));
    Touch a, b;
    for (const auto& [posed, touch] : {std::pair(&thin, &a), std::pair(&thick, &b)}) {
      posed->measureGap(p_W, touch);
      posed->measureFrame(touch);
    }
    EXPECT_EQ(b.gap, a.gap - kMargin) << name;
    EXPECT_EQ(thick.gap(p_W), b.gap) << name;
    EXPECT_EQ(b.normal_W, a.normal_W) << name;
  }
}

// A sample that goes along with the obstacle does not slip, however that moves and turns.
TEST(Touch, DoesNotSlipOnWhatItRidesOn) {
  std::mt19937 rng{3};
  for (const auto& [name, geometry] : testShapes()) {
    const Obstacle obstacle{&geometry, 0, randomPose(&rng, 0.02), randomPose(&rng, 0.02)};
    const Vec3 p_G = randomPoints(&rng, 1, 0.008).col(0);
    const Touch touch = measure(obstacle, obstacle.X_WG_begin * p_G, obstacle.X_WG_end * p_G);
    EXPECT_LT(touch.motion_W.norm(), 1e-16) << name;
    EXPECT_LT(touch.slip().norm(), 1e-16) << name;
  }
}

TEST(Touch, SlipsBackwardsOnATranslatingObstacle) {
  const instrument::Geometry ball = instrument::Sphere{0.01};
  const Obstacle obstacle{&ball, 0, turned(0.3, {1, 2, 3}, Vec3::Zero()),
                          turned(0.3, {1, 2, 3}, Vec3(2e-3, -1e-3, 5e-4))};
  const Vec3 p_W = obstacle.X_WG_end * Vec3(0.0, 0.0, 0.0095);
  const Touch touch = measure(obstacle, p_W + Vec3(1e-4, 0.0, 0.0), p_W);
  const Vec3 motion(-2.1e-3, 1e-3, -5e-4);  // its own -1e-4, less the obstacle's
  EXPECT_LT((touch.motion_W - motion).norm(), 1e-16);
  const Vec3 n = obstacle.X_WG_end.linear().col(2);
  EXPECT_LT((touch.normal_W - n).norm(), 1e-15);
  EXPECT_LT((touch.slipInWorld() - (motion - n * n.dot(motion))).norm(), 1e-16);
  EXPECT_LT((touch.frameTangents() * touch.slip() - touch.slipInWorld()).norm(), 1e-16);
}

// At (r, 0, 0) of a ball that turns about z by an angle, a sample at rest goes past the way
// r sin(angle) along -y, and r (1 - cos(angle)) along the normal.
TEST(Touch, SlipsOnARotatingObstacle) {
  const double r = 0.0098, angle = 0.2;
  const instrument::Geometry ball = instrument::Sphere{0.01};
  const Vec3 center(0.3, -0.2, 0.1), p_W = center + Vec3(r, 0.0, 0.0);
  const Obstacle obstacle{&ball, 0, turned(0.7, Vec3::UnitZ(), center),
                          turned(0.7 + angle, Vec3::UnitZ(), center)};
  const Touch touch = measure(obstacle, p_W, p_W);
  const Vec3 motion(r * (1.0 - std::cos(angle)), -r * std::sin(angle), 0.0);
  EXPECT_LT((touch.motion_W - motion).norm(), 1e-16);
  EXPECT_LT((touch.slipInWorld() - Vec3(0.0, motion.y(), 0.0)).norm(), 1e-16);
  EXPECT_NEAR(touch.slip().norm(), r * std::sin(angle), 1e-16);
}

// The same in a world that is turned and shifted.
TEST(Touch, SlipTurnsWithTheWorld) {
  std::mt19937 rng{4};
  const Pose X = randomPose(&rng, 0.1);
  for (const auto& [name, geometry] : testShapes()) {
    const Obstacle here{&geometry, 0, randomPose(&rng, 0.01), randomPose(&rng, 0.01)};
    const Obstacle there{&geometry, 0, X * here.X_WG_begin, X * here.X_WG_end};
    const Points p = randomPoints(&rng, 2, 0.01);
    const Touch a = measure(here, p.col(0), p.col(1)),
                b = measure(there, X * p.col(0), X * p.col(1));
    EXPECT_LT((X.linear() * a.slipInWorld() - b.slipInWorld()).norm(), 1e-15) << name;
    EXPECT_NEAR(a.gap, b.gap, 1e-15) << name;
  }
}

// The way begins anew where the obstacle is.
TEST(Touch, MotionIsThatSinceTheStepBegan) {
  std::mt19937 rng{5};
  const instrument::Geometry ball = instrument::Sphere{0.01};
  Obstacle obstacle{&ball, 0, randomPose(&rng, 0.01), randomPose(&rng, 0.01)};
  PosedObstacle posed(obstacle);
  const Vec3 p = randomPoints(&rng, 1, 0.01).col(0);
  posed.beginHere();
  Touch touch;
  posed.measureGap(p, &touch);
  posed.measureMotion(p, &touch);
  EXPECT_EQ(touch.motion_W.norm(), 0.0);
  obstacle.X_WG_begin = obstacle.X_WG_end;
  obstacle.X_WG_end.translation().x() += 1e-3;
  posed.move(obstacle);
  posed.measureGap(p, &touch);
  posed.measureMotion(p, &touch);
  EXPECT_LT((touch.motion_W + Vec3(1e-3, 0.0, 0.0)).norm(), 1e-17);
}

}  // namespace
}  // namespace palpate::contact::touch_test

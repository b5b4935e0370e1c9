// SPDX-License-Identifier: GPL-3.0-or-later
// Properties of any friction law: those of the list, and one that is not in the list.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "contact/friction_list.h"
#include "contact/friction_response.h"
#include "contact/penalty_response.h"
#include "support/random.h"

namespace palpate::contact::friction_laws_test {
namespace {

constexpr double kArea = 2e-6, kDepth = 1e-4;  // [m^2], [m]
// Slips below and above the limit of every law [m].
constexpr double kStick = 1e-5, kSlide = 0.1;

// Cohesion c and friction, c A + mu N: not proportional to the normal force. c halves with slip.
class CohesiveFriction final : public FrictionLaw {
 public:
  void describe(keys::FieldVisitor& /*v*/, Friction& /*friction*/) const override {}
  bool acts(const Friction& /*friction*/) const override { return true; }
  FrictionLimit limit(const Friction& /*friction*/, const FrictionLoad& load) const override {
    const double cohesion = load.slides ? 1e3 : 2e3;  // [Pa]
    return {cohesion * load.area + 0.2 * load.normal_force, 0.2};
  }
  bool weakens(const Friction& /*friction*/) const override { return true; }
};

FrictionList allEntries() {
  FrictionList all = frictionList();
  all.push_back({"cohesive", std::make_shared<const CohesiveFriction>(), {}});
  return all;
}

// A sample that is pressed on a turned plane by a penalty, under one law alone.
class EveryFrictionLaw : public ::testing::TestWithParam<std::size_t> {
 protected:
  EveryFrictionLaw() {
    settings.model = "penalty";
    settings.stiffness = 1e8;
    settings.smoothing = 1e-5;
    settings.friction_with.usual = law.front().example;
  }

  std::unique_ptr<Response> make() const {
    return withFriction(makePenaltyResponse(settings), settings, law);
  }
  /// Makes a response at the begin of the second step in which the sample is pressed.
  std::unique_ptr<Response> settled() const {
    auto response = make();
    response->beginStep({pressed});
    response->endStep({pressed});
    response->beginStep({pressed});
    return response;
  }
  /// Augments until the solution `touch` is accepted.
  static void accept(const Touch& touch, Response* response) {
    for (int k = 0; k < 10 && !response->augmentationConverged({touch}); ++k) {
      response->augment({touch});
    }
  }

  Touch pressedTouch() const {
    Touch touch{};
    touch.sample = 3;
    touch.obstacle = touch.number = 0;
    touch.nodes = Eigen::Vector3i(0, 1, 2);
    touch.weights.setConstant(1.0 / 3.0);
    touch.area = kArea;
    touch.radius = touch.room = 0.01;
    touch.gap = -kDepth;
    touch.R_WG = R_WG;
    touch.normal_G = Vec3::UnitZ();
    touch.normal_W = R_WG.col(2);
    touch.steepness = 1.0;
    touch.curvature_G.setZero();
    touch.p_W.setZero();
    touch.p_G.setZero();
    touch.motion_W.setZero();
    return touch;
  }
  /// The touch after its sample has moved by `d` [m].
  static Touch moved(Touch touch, const Vec3& d) {
    touch.p_W += d;
    touch.p_G += touch.R_WG.transpose() * d;
    touch.motion_W += d;
    touch.gap += touch.normal_W.dot(d);
    return touch;
  }
  /// The touch where the normal leans by `angle` [rad] towards `along`.
  static Touch tilted(Touch touch, const Vec3& along, double angle) {
    const Vec3 axis = touch.normal_W.cross(along).normalized();
    touch.normal_W = Eigen::AngleAxisd(angle, axis) * touch.normal_W;
    touch.normal_G = touch.R_WG.transpose() * touch.normal_W;
    return touch;
  }
  /// Force of the tissue on the obstacle [N].
  static Vec3 forceOf(const Response& response, const Touch& touch) {
    const TouchForce force = response.force(touch);
    return force.normal * touch.normal_W + force.other_W;
  }
  Vec3 tangent() { return pressed.normal_W.cross(random.vector(1.0)).normalized(); }
  FrictionLimit limit(double normal_force, bool slides) const {
    return limitOf(law, law.front().example, {normal_force, kArea, slides});
  }
  double holding() const { return kArea * holdingOf(law, law.front().example); }

  FrictionList law{allEntries()[GetParam()]};
  ResponseSettings settings;
  test::Random random;
  Mat3 R_WG = random.rotation();
  Touch pressed = pressedTouch();
};

INSTANTIATE_TEST_SUITE_P(ListAndOne, EveryFrictionLaw,
                         ::testing::Range(std::size_t{0}, allEntries().size()),
                         [](const auto& entry) { return allEntries()[entry.param].name; });

TEST_P(EveryFrictionLaw, LimitIncreasesWithTheNormalForceByItsSlope) {
  EXPECT_GT(std::max(limit(1.0, false).force, holding()), 0.0);
  for (const bool slides : {false, true}) {
    EXPECT_GE(limit(0.0, slides).force, 0.0);
    for (const double N : {1e-3, 1.0, 50.0}) {
      const double h = 1e-4 * N;
      const double difference = limit(N + h, slides).force - limit(N - h, slides).force;
      EXPECT_GE(difference, 0.0);
      EXPECT_NEAR(limit(N, slides).slope, difference / (2.0 * h), 1e-6) << N;
      EXPECT_LE(limit(N, true).force, limit(N, false).force) << N;
    }
  }
  const Friction& constants = law.front().example;
  EXPECT_EQ(anyWeakens(law, constants), limit(1.0, true).force < limit(1.0, false).force);
}

TEST_P(EveryFrictionLaw, ForceOpposesTheSlip) {
  for (const double slip : {kStick, kSlide}) {
    for (int trial = 0; trial < 5; ++trial) {
      const Vec3 along = tangent();
      const Vec3 force = settled()->force(moved(pressed, slip * along)).other_W;
      EXPECT_GT(force.dot(along), 0.0) << slip;
      EXPECT_LT((force - force.dot(along) * along).norm(), 1e-9 * force.norm()) << slip;
    }
  }
}

TEST_P(EveryFrictionLaw, ForceIsZeroWithoutSlip) {
  const auto response = settled();
  EXPECT_EQ(response->force(pressed).other_W, Vec3::Zero());
  const double N = -response->force(pressed).normal;
  ASSERT_GT(N, 0.0);
  const Touch deeper = moved(pressed, -0.1 * kDepth * pressed.normal_W);
  EXPECT_LT(response->force(deeper).other_W.norm(), 1e-12 * N);
  // Nor is there friction before a step in which the sample is pressed.
  const Touch slipped = moved(pressed, kStick * tangent());
  EXPECT_EQ(make()->force(slipped).other_W, Vec3::Zero());
}

// Also where the normal force decreases, and where the normal turns after the last augmentation.
TEST_P(EveryFrictionLaw, ForceOfASolutionIsAtMostTheLimit) {
  for (const double slip : {kStick, kSlide}) {
    for (const double part : {1.0, 0.5, 0.1}) {
      for (const double angle : {0.0, 0.2, -0.2}) {
        const Vec3 along = tangent();
        const auto response = settled();
        const Vec3 lift = (1.0 - part) * kDepth * pressed.normal_W;
        const Touch solution = moved(pressed, slip * along + lift);
        accept(solution, response.get());
        const Touch touch = tilted(solution, along, angle);
        response->confine({touch});
        const Vec3 force = forceOf(*response, touch);
        const double N = -force.dot(touch.normal_W);
        const double friction = (force + N * touch.normal_W).norm();
        const bool slides = slip == kSlide;
        const double most = limit(N, slides).force;
        // What was drawn beyond the limit of holding is held no more.
        const double bound = slides ? most : std::max(most, holding());
        EXPECT_LE(friction, bound * (1.0 + 1e-9) + 1e-15) << slip << ' ' << part << ' ' << angle;
        if (slides && part == 1.0 && angle == 0.0) {
          EXPECT_GE(friction, 0.9 * most);
        }
      }
    }
  }
}

// By central differences, in the normal and two tangential directions, pressed and lifted.
TEST_P(EveryFrictionLaw, ForceAndStiffnessAreDerivativesOfTheEnergy) {
  constexpr double h = 1e-6;
  const auto response = settled();
  const Vec3 along = tangent(), n = pressed.normal_W;
  for (const double slip : {kStick, kSlide}) {
    for (const double lift : {0.0, 1.2 * kDepth}) {
      const Touch touch = moved(pressed, slip * along + lift * n);
      const Vec3 force = forceOf(*response, touch);
      const Mat3 K = response->stiffness(touch, fem::Tangent::kExact);
      for (const Vec3& d : {n, along, Vec3(n.cross(along))}) {
        const Touch after = moved(touch, h * d), before = moved(touch, -h * d);
        const double slope = (response->energy(after) - response->energy(before)) / (2.0 * h);
        EXPECT_NEAR(force.dot(d), slope, 1e-6 * std::abs(slope) + 1e-9) << slip << ' ' << lift;
        const Vec3 change = (forceOf(*response, after) - forceOf(*response, before)) / (2.0 * h);
        EXPECT_LT((K * d - change).norm(), 1e-5 * change.norm() + 1e-9) << slip << ' ' << lift;
      }
    }
  }
}

TEST_P(EveryFrictionLaw, GoesOnFromWhatWasSavedToTheSameBits) {
  for (const double slip : {kStick, kSlide}) {
    const Vec3 along = tangent();
    const auto response = settled(), fresh = settled(), other = make();
    const Touch touch = moved(pressed, slip * along);
    accept(touch, response.get());
    response->confine({touch});
    response->endStep({touch});
    StateWriter saved, again;
    response->save(&saved);
    StateReader reader(saved.bytes());
    other->restore(&reader);
    reader.finish();
    other->save(&again);
    EXPECT_EQ(again.bytes(), saved.bytes());
    response->beginStep({pressed});
    other->beginStep({pressed});
    bool remembers = false;
    for (const double next : {0.0, kStick, kSlide}) {
      const Touch at = moved(pressed, next * along);
      EXPECT_EQ(forceOf(*other, at), forceOf(*response, at)) << slip << ' ' << next;
      EXPECT_EQ(other->energy(at), response->energy(at)) << slip << ' ' << next;
      remembers |= forceOf(*fresh, at) != forceOf(*response, at);
    }
    EXPECT_TRUE(remembers) << slip;
  }
}

TEST(FrictionLaws, HaveNoEffectWithoutTheirConstants) {
  std::set<std::string> names;
  for (const FrictionEntry& entry : frictionList()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    for (const bool slides : {false, true}) {
      EXPECT_EQ(entry.law->limit({}, {1.0, kArea, slides}).force, 0.0) << entry.name;
    }
    EXPECT_FALSE(entry.law->weakens({})) << entry.name;
    EXPECT_EQ(entry.law->holding({}), 0.0) << entry.name;
    EXPECT_TRUE(entry.example.any()) << entry.name;
    for (const FrictionEntry& other : frictionList()) {
      EXPECT_EQ(other.law->acts(entry.example), &other == &entry) << other.name;
    }
  }
  EXPECT_FALSE(Friction().any());
}

}  // namespace
}  // namespace palpate::contact::friction_laws_test

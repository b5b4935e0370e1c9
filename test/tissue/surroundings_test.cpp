// SPDX-License-Identifier: GPL-3.0-or-later
// Supports that move, springs, and both together, by every method.
#include "palpate/tissue/surroundings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "liver_slab.h"
#include "palpate/mesh/selection.h"
#include "palpate/tissue/fem/islands.h"
#include "support/contains.h"
#include "tissue/adaptation/adaptive_tissue.h"

namespace palpate::tissue::surroundings_test {
namespace {

constexpr double kStep = 0.01;
const Vec3 kAmplitude(0.002, 0.0, 0.004);
constexpr double kPeriod = 2.0;

Motion breathing() {
  Wave wave;
  wave.form = "cos4";
  wave.amplitude = kAmplitude;
  wave.period = kPeriod;
  return Motion(wave);
}

std::vector<int> bottomOf(const mesh::TetMesh& mesh) {
  return mesh::selectPoints(mesh.points, mesh::PlaneRegion{});
}

// The slab, whose bottom is glued to something that breathes, lies on springs, or both.
struct Held : test::LiverSlab {
  explicit Held(const std::string& method, const std::string& element = "anp")
      : LiverSlab(method, Eigen::Vector3i(5, 5, 3), element), surroundings(free) {
    settings.gravity = Vec3(0.0, 0.0, -9.81);
    settings.mass_damping = 5.0;
  }
  void glueToBreathing() { surroundings.carried.push_back({bottomOf(mesh), breathing()}); }
  void layOnSprings(const fem::FoundationConstants& constants, bool breathe) {
    surroundings.free.setOnes();
    surroundings.springs.push_back(
        {bottomOf(mesh), constants, breathe ? std::optional<Motion>(breathing()) : std::nullopt});
  }
  std::unique_ptr<TissueModel> make() const {
    return makeIslands(mesh, fem::Composition::uniform(law, density), surroundings, settings);
  }
  Surroundings surroundings;
};

// A ball in the middle of the top, as deep as that or moved by `offset`.
class Ball {
 public:
  explicit Ball(double depth) : at_(Vec3(0.05, 0.05, 0.05 - depth)) {}
  contact::Obstacle to(const Vec3& offset) {
    const Vec3 begin = now_;
    now_ = at_ + offset;
    return {&shape_, 0, poseFromXyzRpy(begin, Vec3::Zero()), poseFromXyzRpy(now_, Vec3::Zero())};
  }
  // Down from where it touches nothing, within 0.2 s.
  Vec3 comes(double t) const { return Vec3(0.0, 0.0, 0.012 * std::max(0.0, 1.0 - t / 0.2)); }

 private:
  instrument::Geometry shape_ = instrument::Sphere{0.01};
  Vec3 at_, now_ = at_ + Vec3(0.0, 0.0, 0.012);
};

Vec3 onTool(const TissueStep& step) {
  Vec3 sum = Vec3::Zero();
  for (const TissueContact& c : step.contacts) sum += c.force_W;
  return sum;
}

Vec3 imbalance(const TissueStep& step) {
  return step.support_force + step.gravity_force + step.inertia_force - onTool(step);
}

bool isImplicit(const std::string& method) { return methodFacts(method).own_integration.empty(); }

class MethodsInSurroundings : public ::testing::TestWithParam<std::string> {
 protected:
  // What the sum of forces may be off by: the residual of as many nodes.
  static double offBalance(const Held& held, const TissueStep& step) {
    return std::sqrt(static_cast<double>(held.mesh.numPoints())) * step.tolerance + 1e-9;
  }
};
std::vector<std::string> solvingMethods() {
  std::vector<std::string> names = methodNames();
  names.erase(std::find(names.begin(), names.end(), "auto"));
  return names;
}
INSTANTIATE_TEST_SUITE_P(Methods, MethodsInSurroundings, ::testing::ValuesIn(solvingMethods()),
                         [](const auto& method) { return method.param; });

// An organ that is carried feels a tool as one that rests feels the tool moved the other way. What
// differs is the inertia of the organ, its mass times the largest acceleration, and of methods with
// damping by mass its braking.
TEST_P(MethodsInSurroundings, FeelsAToolAgainstWhichItBreathes) {
  if (GetParam() == "newton_bicgstab") {
    GTEST_SKIP() << "its points stick where they were caught, and it is not the same ones that are "
                    "caught by a tool that comes and by tissue that comes";
  }
  Held moving(GetParam()), resting(GetParam());
  moving.glueToBreathing();
  if (isImplicit(GetParam())) {
    moving.settings.integrator = resting.settings.integrator = "static";
    moving.settings.tolerance = resting.settings.tolerance = 1e-7;
    moving.settings.position_tolerance = resting.settings.position_tolerance = 0.0;
  }
  const auto carried = moving.make(), at_rest = resting.make();
  const Motion motion = breathing();
  Ball a(0.004), b(0.004);
  double worst = 0.0, least = 1e9, most = 0.0, allowed = 0.0;
  for (int k = 1; k <= 400; ++k) {
    const double t = kStep * k;
    const TissueStep& one = carried->step({a.to(a.comes(t))}, kStep);
    const TissueStep& other = at_rest->step({b.to(b.comes(t) - motion.at(t))}, kStep);
    ASSERT_TRUE(one.ok() && other.ok()) << "cycle " << k;
    const Vec3 f = onTool(one), g = onTool(other);
    if (t > 0.25) {
      worst = std::max(worst, (f - g).norm());
      least = std::min(least, f.z()), most = std::max(most, f.z());
    }
    allowed = std::max(allowed, 2.0 * offBalance(moving, one));
    EXPECT_LE(imbalance(one).norm(), offBalance(moving, one)) << "cycle " << k;
    EXPECT_FALSE(one.slept);
  }
  if (GetParam() == "tled") {
    // |d^2/dt^2 cos^4| <= 4 pi^2/T^2, |d/dt| <= 4 * 0.325 pi/T; the first period ramps, slower.
    const double mass = 0.1 * 0.1 * 0.04 * moving.density;
    const double acceleration = 4.0 * M_PI * M_PI / (kPeriod * kPeriod) * kAmplitude.norm();
    const double speed = 1.3 * M_PI / kPeriod * kAmplitude.norm();
    allowed += mass * (acceleration + moving.settings.mass_damping * speed);
  }
  std::printf("%s: force %.4f to %.4f N, differs by %.2e N, allowed %.2e N\n", GetParam().c_str(),
              least, most, worst, allowed);
  EXPECT_GT(most, 2.0 * least);
  EXPECT_LE(worst, allowed);
}

// A slab on springs sinks by its weight over their stiffness, and the springs carry it.
TEST_P(MethodsInSurroundings, LiesOnSprings) {
  Held held(GetParam());
  held.layOnSprings({2.0e5, 5.0e4, 0.0, 0.0}, false);
  held.settings.tolerance = 1e-8;
  const auto tissue = held.make();
  const double weight = 0.1 * 0.1 * 0.04 * held.density * 9.81;
  const std::vector<int> bottom = bottomOf(held.mesh);
  // Each node by its area; the stresses' mean is the weight's.
  const Points forces = fem::tractionForces(
      held.mesh.points, fem::selectFaces(mesh::boundaryFaces(held.mesh), bottom), Vec3::UnitX());
  const Points sunk = tissue->positions() - held.mesh.points;
  const double mean = sunk.row(2).dot(forces.row(0)) / forces.row(0).sum();
  const double expected = -weight / (2.0e5 * 0.01);
  std::printf("%s: sinks %.6f mm, expected %.6f mm\n", GetParam().c_str(), 1e3 * mean,
              1e3 * expected);
  EXPECT_NEAR(mean, expected, 1e-6 * std::abs(expected));
  bool slept = false;
  for (int k = 0; k < 30; ++k) {
    const TissueStep& step = tissue->step({}, kStep);
    EXPECT_NEAR(step.support_force.z(), weight, 1e-4 * weight);
    EXPECT_LE(imbalance(step).norm(), offBalance(held, step));
    slept = step.slept;
  }
  EXPECT_TRUE(slept || GetParam() == "tled");
}

// Springs whose anchors breathe, pressed, in balance to the last digits that are solved for.
TEST_P(MethodsInSurroundings, BalancesOnSpringsThatBreathe) {
  Held held(GetParam());
  held.layOnSprings({2.0e5, 5.0e4, 0.0, 0.0}, true);
  held.settings.tolerance = 1e-12;
  held.settings.position_tolerance = 1e-15;
  held.settings.linear_tolerance = 1e-8;
  const auto tissue = held.make();
  Ball ball(0.004);
  double worst = 0.0, scale = 0.0, lowest = 1e9, highest = -1e9;
  for (int k = 1; k <= 250; ++k) {
    const TissueStep& step = tissue->step({ball.to(ball.comes(kStep * k))}, kStep);
    ASSERT_TRUE(step.status == solver::SolveStatus::kConverged ||
                step.status == solver::SolveStatus::kLineSearchFailed ||
                step.status == solver::SolveStatus::kIterationLimit)
        << k;
    const double forces = std::max(step.support_force.norm(), step.gravity_force.norm());
    worst = std::max(worst, imbalance(step).norm() / forces);
    scale = std::max(scale, forces);
    lowest = std::min(lowest, onTool(step).z()), highest = std::max(highest, onTool(step).z());
  }
  std::printf("%s: imbalance %.1e of the forces, on the tool up to %.3f N\n", GetParam().c_str(),
              worst, highest);
  EXPECT_GT(highest, 0.05);
  EXPECT_LE(worst, 1e-9);
}

TEST(Surroundings, OfIslandsAreThoseOfEachPart) {
  Held held("implicit_pcg");
  const Eigen::Index n = held.mesh.numPoints(), m = held.mesh.numTets();
  held.mesh.points.conservativeResize(3, 2 * n);
  held.mesh.points.rightCols(n) = held.mesh.points.leftCols(n).colwise() + Vec3(0.2, 0.0, 0.0);
  held.mesh.tets.conservativeResize(4, 2 * m);
  held.mesh.tets.rightCols(m) = held.mesh.tets.leftCols(m).array() + static_cast<int>(n);
  held.surroundings = Surroundings(fem::FreeMask::Ones(3, 2 * n));
  std::vector<int> left, right;
  for (const int i : bottomOf(held.mesh)) {
    (i < n ? left : right).push_back(i);
    held.surroundings.free.col(i).setZero();
  }
  held.surroundings.carried.push_back({left, breathing()});
  const auto tissue = held.make();
  const Points begin = tissue->positions();
  int asleep = 0;
  for (int k = 0; k < 100; ++k) asleep = tissue->step({}, kStep).sleeping_islands;
  EXPECT_EQ(asleep, 1);  // the one that does not breathe
  const Points way = tissue->positions() - begin;
  for (const int i : left) EXPECT_LT((way.col(i) - breathing().at(1.0)).norm(), 1e-12);
  for (const int i : right) EXPECT_EQ(way.col(i), Vec3::Zero());
}

TEST(Surroundings, SleepOnSpringsAndNeverWhereSomethingMoves) {
  for (const bool moves : {false, true}) {
    Held held("implicit_pcg");
    held.layOnSprings({2.0e5, 5.0e4, 100.0, 100.0}, moves);
    const auto tissue = held.make();
    bool slept = false;
    for (int k = 0; k < 10; ++k) slept = tissue->step({}, kStep).slept;
    EXPECT_EQ(slept, !moves);
  }
}

// Where two motions overlap, the last one applies; held nodes stay held where springs act, too.
TEST(Surroundings, ThatOverlapHoldAsTheLastMotionSays) {
  Held held("implicit_pcg");
  Wave wave;
  wave.amplitude = Vec3(0.0, 0.003, 0.0);
  wave.period = 1.0;
  held.glueToBreathing();
  const std::vector<int> bottom = bottomOf(held.mesh);
  const std::vector<int> some(bottom.begin(), bottom.begin() + 7);
  held.surroundings.carried.push_back({some, Motion(wave)});
  held.surroundings.springs.push_back({bottom, {1e5, 1e5, 0.0, 0.0}, std::nullopt});
  const auto tissue = held.make();
  for (int k = 1; k <= 30; ++k) {
    const TissueStep& step = tissue->step({}, kStep);
    ASSERT_TRUE(step.ok());
    for (std::size_t b = 0; b < bottom.size(); ++b) {
      const Vec3 way = tissue->positions().col(bottom[b]) - held.mesh.points.col(bottom[b]);
      const Vec3 told = b < some.size() ? Motion(wave).at(kStep * k) : breathing().at(kStep * k);
      EXPECT_LT((way - told).norm(), 1e-12);
    }
    EXPECT_LE(imbalance(step).norm(),
              std::sqrt(static_cast<double>(held.mesh.numPoints())) * step.tolerance + 1e-9);
  }
}

// A finer mesh where the tool is: the same springs, the same motion.
TEST(Surroundings, GoOnOnAdaptedMeshes) {
  for (const bool on_springs : {false, true}) {
    Held held("implicit_pcg");
    held.mesh = mesh::boxMesh(Vec3(0.1, 0.1, 0.04), Eigen::Vector3i(4, 4, 2));
    held.surroundings = Surroundings(fem::FreeMask::Ones(3, held.mesh.numPoints()));
    if (on_springs) {
      held.layOnSprings({2.0e5, 5.0e4, 0.0, 0.0}, true);
    } else {
      for (const int i : bottomOf(held.mesh)) held.surroundings.free.col(i).setZero();
      held.glueToBreathing();
    }
    const auto adaptive =
        makeAdaptiveTissue(held.mesh, fem::Composition::uniform(held.law, held.density),
                           held.surroundings, held.settings, {0.006, 0.3});
    Ball ball(0.004);
    std::uint64_t revision = adaptive->surfaceState(0).revision;
    int changes = 0;
    double weight = 0.0;
    for (int k = 1; k <= 200; ++k) {
      const TissueStep& step = adaptive->step({ball.to(ball.comes(kStep * k))}, kStep);
      ASSERT_TRUE(step.ok());
      const SurfaceState shape = adaptive->surfaceState(0);
      EXPECT_LE(imbalance(step).norm(),
                std::sqrt(static_cast<double>(shape.positions.cols())) * step.tolerance + 1e-9);
      changes += shape.revision != revision;
      revision = shape.revision;
      weight = step.gravity_force.norm();
      if (on_springs) continue;
      const Vec3 told = breathing().at(kStep * k);
      const Points& rest = adaptive->cells(0).points;
      for (Eigen::Index i = 0; i < rest.cols(); ++i) {
        if (rest(2, i) > 1e-12) continue;
        ASSERT_LT((shape.positions.col(i) - rest.col(i) - told).norm(), 1e-10) << "cycle " << k;
      }
    }
    EXPECT_GE(changes, 1);
    EXPECT_GT(weight, 0.0);
  }
}

TEST(Surroundings, WithDampersAreRefusedByMethodsWithoutVelocities) {
  for (const std::string& method : methodNames()) {
    Held held(method);
    held.layOnSprings({2.0e5, 5.0e4, 10.0, 0.0}, false);
    if (methodFacts(method).spring_damping) {
      EXPECT_NO_THROW(held.make()) << method;
      continue;
    }
    try {
      held.make();
      ADD_FAILURE() << method;
    } catch (const std::invalid_argument& error) {
      EXPECT_TRUE(test::contains(error.what(), "method " + method +
                                                   " knows no damping of supports; leave "
                                                   "normal_damping, tangential_damping out"))
          << error.what();
    }
  }
}

}  // namespace
}  // namespace palpate::tissue::surroundings_test

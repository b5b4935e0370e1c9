// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/spring_network.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "palpate/springs/network_statics.h"
#include "support/contains.h"
#include "support/random.h"

namespace palpate::springs::spring_network_test {
namespace {

using test::contains;

Spring spring(int a, int b, double preload = 0.7, double stiffness = 3.0) {
  return {a, b, stiffness, preload, 0.1, 1.2, SpringKind::kStructural};
}

SpringNetwork tetrahedron() {
  SpringNetwork network;
  network.points.resize(3, 4);
  network.points << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  int i = 0;
  for (int a = 0; a < 4; ++a) {
    for (int b = a + 1; b < 4; ++b) {
      network.springs.push_back(spring(a, b, 0.3 * i - 0.6, 1.0 + i));
      ++i;
    }
  }
  network.masses = Eigen::VectorXd::Constant(4, 0.5);
  return network;
}

TEST(SpringNetwork, ForceIsTheSlopeOfTheEnergyAndTheTangentThatOfTheForce) {
  test::Random random;
  constexpr double h = 1e-6;
  for (int trial = 0; trial < 20; ++trial) {
    const Spring s = spring(0, 1, random.uniform(-2, 2), random.uniform(0, 5));
    const Vec3 d = random.vector(1.0) + Vec3(1.5, 0.0, 0.0), v = random.vector(1.0);
    const double u = d.norm();
    EXPECT_DOUBLE_EQ(springForce(s, s.length), s.preload);
    EXPECT_NEAR((springEnergy(s, u + h) - springEnergy(s, u - h)) / (2 * h), springForce(s, u),
                1e-8);
    const double slope =
        (springEnergy(s, (d + h * v).norm()) - springEnergy(s, (d - h * v).norm())) / (2 * h);
    EXPECT_NEAR(springForceOnA(s, d).dot(v), slope, 1e-8);  // dE/dd pulls a towards b
    const Vec3 change = (springForceOnA(s, d + h * v) - springForceOnA(s, d - h * v)) / (2 * h);
    EXPECT_LT((springTangent(s, d) * v - change).norm(), 1e-8);
  }
}

TEST(SpringNetwork, EnergyForcesAndTangentOfANetworkAgree) {
  test::Random random;
  const SpringNetwork network = tetrahedron();
  const Points x = network.points + random.points(4, 0.2), v = random.points(4, 1.0);
  constexpr double h = 1e-6;
  const Points up = x + h * v, down = x - h * v;
  const double slope = (networkEnergy(network, up) - networkEnergy(network, down)) / (2 * h);
  EXPECT_NEAR(-networkForces(network, x).cwiseProduct(v).sum(), slope, 1e-8);
  const Points change = (networkForces(network, up) - networkForces(network, down)) / (2 * h);
  const Eigen::VectorXd Kv =
      networkTangent(network, x) * Eigen::Map<const Eigen::VectorXd>(v.data(), v.size());
  EXPECT_LT((Kv + Eigen::Map<const Eigen::VectorXd>(change.data(), change.size())).norm(), 1e-7);
}

TEST(SpringNetwork, ForcesHaveNoSumAndNoMoment) {
  test::Random random;
  const SpringNetwork network = tetrahedron();
  const Points x = network.points + random.points(4, 0.3);
  const Points forces = networkForces(network, x);
  Vec3 moment = Vec3::Zero();
  for (int i = 0; i < 4; ++i) moment += x.col(i).cross(forces.col(i));
  EXPECT_LT(forces.rowwise().sum().norm(), 1e-14);
  EXPECT_LT(moment.norm(), 1e-14);
}

TEST(SpringNetwork, EndsThatMeetGiveNoForce) {
  EXPECT_EQ(springForceOnA(spring(0, 1), Vec3::Zero()), Vec3::Zero());
  EXPECT_TRUE(springTangent(spring(0, 1), Vec3::Zero()).allFinite());
}

TEST(SpringNetwork, KindsHaveNames) {
  for (const std::string& name : springKindNames()) {
    ASSERT_TRUE(springKindOf(name)) << name;
    EXPECT_EQ(toString(*springKindOf(name)), name);
  }
  EXPECT_FALSE(springKindOf("bent"));
}

TEST(SpringNetwork, RefusesWhatCannotBe) {
  EXPECT_NO_THROW(checkNetwork(tetrahedron()));
  const auto refusal = [](auto&& change) {
    SpringNetwork network = tetrahedron();
    change(network);
    try {
      checkNetwork(network);
    } catch (const std::invalid_argument& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto spring2 = [&](auto&& change) {
    return refusal([&](SpringNetwork& n) { change(n.springs[2]); });
  };
  EXPECT_TRUE(contains(spring2([](Spring& s) { s.b = s.a; }), "spring 2: both ends are point 0"));
  EXPECT_TRUE(contains(spring2([](Spring& s) { s.b = 4; }), "spring 2: point 4 is none of the 4"));
  EXPECT_TRUE(contains(spring2([](Spring& s) { s.a = -1; }), "spring 2: point -1 is none"));
  EXPECT_TRUE(contains(spring2([](Spring& s) { s.length = 0.0; }), "spring 2: length = 0; must"));
  EXPECT_TRUE(contains(spring2([](Spring& s) { s.stiffness = -1.0; }), "spring 2: stiffness = -1"));
  EXPECT_TRUE(contains(spring2([](Spring& s) { s.damping = -2.0; }), "spring 2: damping = -2"));
  EXPECT_TRUE(contains(spring2([](Spring& s) { s.preload = nan; }), "spring 2: preload = nan"));
  EXPECT_TRUE(
      contains(refusal([](SpringNetwork& n) { n.masses[3] = 0.0; }), "point 3: mass = 0; must"));
  EXPECT_TRUE(contains(refusal([](SpringNetwork& n) { n.masses.resize(2); }), "2 masses for 4"));
  EXPECT_TRUE(contains(refusal([](SpringNetwork& n) { n.points(1, 1) = nan; }), "point 1: is not"));
}

}  // namespace
}  // namespace palpate::springs::spring_network_test

// SPDX-License-Identifier: GPL-3.0-or-later
// The energy of springs in a box of tetrahedra against differences, and what it must leave alone.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numeric>
#include <vector>

#include "support/random.h"
#include "tissue/models/springs/spring_elasticity.h"

namespace palpate::tissue::spring_elasticity_test {
namespace {

fem::Composition soft() {
  return fem::Composition::uniform(
      material::makeMaterial("neo_hookean", {{"young_modulus", {1e4}}, {"poisson_ratio", {0.25}}}));
}

// Springs along each edge of a box, and some that are none, all unlike and with preload.
class Springs : public ::testing::Test {
 protected:
  Springs()
      : mesh_(mesh::boxMesh(Vec3(0.03, 0.04, 0.02), Eigen::Vector3i(2, 2, 1))),
        elasticity_(mesh_, soft(), network()) {
    x_ = mesh_.points + test::Random(7).points(mesh_.numPoints(), 0.003);
  }
  springs::SpringNetwork network() const {
    springs::SpringNetwork net{mesh_.points, {}, Eigen::VectorXd::Ones(mesh_.numPoints())};
    const auto n = static_cast<int>(mesh_.numPoints());
    for (int a = 0; a < n; ++a) {
      for (int b = a + 1; b < n; ++b) {
        const double length = (mesh_.points.col(a) - mesh_.points.col(b)).norm();
        if (length > 0.03 || (a + b) % 5 == 0) continue;
        net.springs.push_back(
            {a, b, 20.0 + 3.0 * a, (b % 3 - 1) * 0.02, 0.0, length, springs::SpringKind::kEdge});
      }
    }
    return net;
  }

  mesh::TetMesh mesh_;
  SpringElasticity elasticity_;
  Points x_;
};

TEST_F(Springs, GradientIsThatOfTheEnergy) {
  Points g;
  const double energy = elasticity_.gradient(x_, &g);
  EXPECT_NEAR(energy, elasticity_.energy(x_), 1e-15);
  const double h = 1e-7;
  for (Eigen::Index k = 0; k < x_.size(); ++k) {
    Points there = x_, here = x_;
    there.data()[k] += h;
    here.data()[k] -= h;
    const double slope = (elasticity_.energy(there) - elasticity_.energy(here)) / (2.0 * h);
    EXPECT_NEAR(g.data()[k], slope, 1e-7 * g.cwiseAbs().maxCoeff());
  }
}

// Also where a spring has no length.
TEST_F(Springs, HaveTheSameBitsWithAnyInstructions) {
  const springs::SpringNetwork net = network();
  x_.col(net.springs[1].b) = x_.col(net.springs[1].a);
  const SpringArrays reference(net, Isa::kBaseline);
  Points expected = Points::Zero(3, x_.cols());
  const double energy = reference.addGradient(x_, &expected);
  ASSERT_TRUE(std::isfinite(energy) && expected.allFinite());
  std::vector<int> all(net.springs.size());
  std::iota(all.begin(), all.end(), 0);
  Points one_by_one = Points::Zero(3, x_.cols());
  reference.addGradient(x_, all, &one_by_one);
  EXPECT_LT((one_by_one - expected).norm(), 1e-14 * expected.norm());
  for (const Isa isa : availableIsas()) {
    const SpringArrays springs(net, isa);
    Points g = Points::Zero(3, x_.cols());
    EXPECT_EQ(springs.addGradient(x_, &g), energy) << toString(isa);
    EXPECT_EQ(springs.energy(x_), energy) << toString(isa);
    EXPECT_EQ(g, expected) << toString(isa);
  }
}

TEST_F(Springs, HessianIsThatOfTheGradient) {
  fem::Stiffness K = elasticity_.makeMatrix();
  elasticity_.hessian(x_, fem::Tangent::kExact, &K);
  const double h = 1e-7;
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Points d = test::Random(seed).points(x_.cols(), 1.0);
    Points there, here, Kd;
    elasticity_.gradient(x_ + h * d, &there);
    elasticity_.gradient(x_ - h * d, &here);
    K.multiply(d, &Kd);
    EXPECT_LT((Kd - (there - here) / (2.0 * h)).norm(), 1e-6 * Kd.norm());
  }
}

TEST_F(Springs, ProjectedHessianIsPositive) {
  fem::Stiffness exact = elasticity_.makeMatrix(), projected = elasticity_.makeMatrix();
  const Points crushed = 0.5 * mesh_.points;  // where springs are pressed and give way aside
  elasticity_.hessian(crushed, fem::Tangent::kExact, &exact);
  elasticity_.hessian(crushed, fem::Tangent::kProjected, &projected);
  const auto least = [&](const fem::Stiffness& K) {
    const Eigen::Index n = crushed.size();
    Eigen::MatrixXd dense(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      Points unit = Points::Zero(3, crushed.cols()), column;
      unit.data()[k] = 1.0;
      K.multiply(unit, &column);
      dense.col(k) = column.reshaped();
    }
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense).eigenvalues();
    return values.minCoeff() / values.cwiseAbs().maxCoeff();
  };
  EXPECT_LT(least(exact), -1e-3);
  EXPECT_GT(least(projected), -1e-12);
}

TEST_F(Springs, HaveNoForceNorMomentAsAWholeAndTurnWithTheBody) {
  Points g, turned_g;
  const double energy = elasticity_.gradient(x_, &g);
  Vec3 moment = Vec3::Zero();
  for (Eigen::Index i = 0; i < x_.cols(); ++i) moment += Vec3(x_.col(i)).cross(Vec3(g.col(i)));
  EXPECT_LT(g.rowwise().sum().norm(), 1e-13 * g.norm());
  EXPECT_LT(moment.norm(), 1e-13 * g.norm());
  const Mat3 R = Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Points turned = (R * x_).colwise() + Vec3(0.1, -0.2, 0.3);
  EXPECT_NEAR(elasticity_.gradient(turned, &turned_g), energy, 1e-12 * energy);
  EXPECT_LT((turned_g - R * g).norm(), 1e-10 * g.norm());
}

TEST_F(Springs, GiveTheirEnergyAndMassToTheTetrahedra) {
  EXPECT_NEAR(elasticity_.masses().sum(), 1000.0 * 0.03 * 0.04 * 0.02, 1e-15);
  EXPECT_NEAR(elasticity_.lumpedMasses().shares.sum(), 1000.0 * 0.03 * 0.04 * 0.02, 1e-15);
  EXPECT_NEAR(elasticity_.minJacobian(1.1 * mesh_.points), 1.1 * 1.1 * 1.1, 1e-12);
}

// Springs along all edges, E V / L^2 each: of the mean stress of a strain, the work is the energy.
TEST_F(Springs, StressDoesTheWorkOfTheEnergy) {
  springs::SpringNetwork net = network();
  std::vector<springs::Spring> edges;
  for (const springs::Spring& s : net.springs) {
    springs::Spring spring = s;
    spring.preload = 0.0;
    bool edge = false;
    for (Eigen::Index t = 0; t < mesh_.numTets(); ++t) {
      edge = edge ||
             ((mesh_.tets.col(t).array() == s.a).any() && (mesh_.tets.col(t).array() == s.b).any());
    }
    if (edge) edges.push_back(spring);
  }
  net.springs = edges;
  SpringElasticity body(mesh_, soft(), net);
  const Mat3 strain = (Mat3() << 1e-4, 2e-5, 0, 2e-5, -5e-5, 0, 0, 0, 3e-5).finished();
  const Points x = (Mat3::Identity() + strain) * mesh_.points;
  double work = 0.0;
  for (int t = 0; t < static_cast<int>(mesh_.numTets()); ++t) {
    const fem::PointState state = body.states(x, {{t, Eigen::Vector4d::Constant(0.25)}}).front();
    work += 0.5 * mesh::signedVolume(mesh_.points, mesh_.tets.col(t)) *
            state.cauchy_stress.cwiseProduct(strain).sum();
    EXPECT_LT((state.F - Mat3::Identity() - strain).norm(), 1e-12);
  }
  EXPECT_NEAR(work, body.energy(x), 1e-3 * work);
  EXPECT_NEAR(body.energyBySolid(x).sum(), body.energy(x), 1e-12 * work);
}

TEST_F(Springs, RefuseNetworksOfOtherPoints) {
  springs::SpringNetwork net = network();
  net.points.conservativeResize(3, net.points.cols() + 1);
  net.points.rightCols(1).setZero();
  net.masses = Eigen::VectorXd::Ones(net.points.cols());
  EXPECT_THROW(SpringElasticity(mesh_, soft(), net), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::tissue::spring_elasticity_test

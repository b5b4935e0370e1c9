// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/integrator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/fem/elasticity.h"
#include "palpate/solver/cholmod_solver.h"
#include "palpate/solver/line_search.h"
#include "palpate/solver/newton.h"

namespace palpate::solver::integrator_test {
namespace {

// A block held at the bottom, pushed to the side and let go.
struct Swing {
  mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.05, 0.05, 0.1), Eigen::Vector3i(1, 1, 3));
  std::unique_ptr<fem::Elasticity> body = fem::makeElasticity(
      "anp", mesh,
      fem::Composition::uniform(material::makeMaterial(
          "neo_hookean", {{"young_modulus", {5e3}}, {"poisson_ratio", {0.45}}})));
  fem::FreeMask free = fem::FreeMask::Ones(3, mesh.numPoints());
  Integrator time;
  Potential potential;
  Newton newton;
  Points x = mesh.points;

  explicit Swing(const std::string& integrator, const RayleighDamping& damping = {})
      : time(integrator, body->masses(), damping),
        newton(body->makeMatrix(), std::make_unique<CholmodSolver>()) {
    for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
      if (mesh.points(2, i) == 0.0) free.col(i).setZero();
      x(0, i) += 2.0 * mesh.points(2, i) * mesh.points(2, i);
    }
    potential = {body.get(), {}, free, 1.0};
    time.addTerms(&potential);
    time.start(x, Points::Zero(3, x.cols()));
    Points g;
    body->gradient(x, &g);
    time.setElasticGradient(g);
  }
  double energy() {
    return body->energy(x) +
           0.5 * time.velocities().colwise().squaredNorm().dot(body->masses().transpose());
  }
  void step(double h, double unbalanced = 0.0) {
    time.beginStep(h, &potential);
    NewtonSettings settings;
    settings.tolerance = 1e-9;
    ASSERT_EQ(newton.minimize(potential, settings, &x).status, SolveStatus::kConverged);
    Points g;
    body->gradient(x, &g);
    time.endStep(x, g, unbalanced);
  }
};

TEST(Integrator, RefusesAnUnknownName) {
  EXPECT_THROW(Integrator("rk4", Eigen::VectorXd::Ones(2), {}), std::invalid_argument);
}

TEST(Integrator, EnergyNeverGrows) {
  for (const char* name : {"backward_euler", "bdf2"}) {
    Swing swing(name);
    const double begin = swing.energy();
    for (int k = 0; k < 100; ++k) swing.step(0.005);
    EXPECT_LT(swing.energy(), begin) << name;
  }
}

TEST(Integrator, Bdf2KeepsMoreOfTheSwing) {
  Swing euler("backward_euler"), bdf2("bdf2");
  for (int k = 0; k < 100; ++k) {
    euler.step(0.005);
    bdf2.step(0.005);
  }
  EXPECT_GT(bdf2.energy(), 2.0 * euler.energy());
}

TEST(Integrator, EachKindOfDampingTakesEnergyAway) {
  Swing free_swing("bdf2"), by_mass("bdf2", {5.0, 0.0}), by_stiffness("bdf2", {0.0, 0.02});
  for (int k = 0; k < 60; ++k) {
    free_swing.step(0.002);
    by_mass.step(0.002);
    by_stiffness.step(0.002);
  }
  EXPECT_LT(by_mass.energy(), 0.8 * free_swing.energy());
  EXPECT_LT(by_stiffness.energy(), 0.8 * free_swing.energy());
}

// A free body under damping by mass alone slows down as exp(-alpha t).
TEST(Integrator, DampingByMassIsTheClosedForm) {
  Swing swing("bdf2", {3.0, 0.0});
  swing.potential.free.setOnes();
  swing.x = swing.mesh.points;
  Points v = Points::Zero(3, swing.x.cols());
  v.row(1).setConstant(0.1);
  swing.time.start(swing.x, v);
  for (int k = 0; k < 200; ++k) swing.step(0.001);
  EXPECT_NEAR(swing.time.velocities()(1, 3), 0.1 * std::exp(-0.6), 1e-6);
  EXPECT_NEAR(swing.x(1, 3) - swing.mesh.points(1, 3), 0.1 * (1.0 - std::exp(-0.6)) / 3.0, 1e-6);
}

TEST(Integrator, StaticIsAtOnceInEquilibrium) {
  Swing swing("static");
  swing.step(0.01);
  EXPECT_LT((swing.x - swing.mesh.points).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(Integrator, LengthsOfStepsMayChange) {
  Swing even("bdf2"), uneven("bdf2");
  for (int k = 0; k < 200; ++k) even.step(0.0005);
  for (int k = 0; k < 100; ++k) uneven.step(0.0005);
  for (int k = 0; k < 50; ++k) uneven.step(0.001);
  EXPECT_LT((even.x - uneven.x).norm(), 0.03 * (even.x - even.mesh.points).norm());
}

// The block three times as long and wide, let go, of which the most energy [of that at the start].
double mostEnergyOfStretchedBlock(bool told_of_balance) {
  Swing swing("backward_euler", {0.0, 1e-3});
  swing.x = swing.mesh.points + 2.0 * swing.mesh.points.cwiseProduct(swing.free);
  swing.time.start(swing.x, Points::Zero(3, swing.x.cols()));
  Points g;
  swing.body->gradient(swing.x, &g);
  const auto unbalanced = [&] { return told_of_balance ? freeNorm(g, swing.free) : 0.0; };
  swing.time.setElasticGradient(g, unbalanced());
  const double begin = swing.energy();
  double most = 0.0;
  for (int k = 0; k < 20; ++k) {
    swing.time.beginStep(1e-3, &swing.potential);
    NewtonSettings settings;
    settings.tolerance = 1e-9;
    settings.max_iterations = 20;
    swing.newton.minimize(swing.potential, settings, &swing.x);
    swing.body->gradient(swing.x, &g);
    swing.time.endStep(swing.x, g, unbalanced());
    most = std::max(most, swing.energy() / begin);
  }
  return most;
}

TEST(Integrator, ForcesOutOfBalanceDriveNothing) {
  EXPECT_GT(mostEnergyOfStretchedBlock(false), 2.0);
  EXPECT_LE(mostEnergyOfStretchedBlock(true), 1.0);
}

TEST(Integrator, StateKnowsWhatWasOutOfBalance) {
  for (const double unbalanced : {0.0, 1e9}) {
    Swing swing("bdf2", {0.0, 1e-3}), other("bdf2", {0.0, 1e-3});
    for (int k = 0; k < 3; ++k) swing.step(0.005, k > 0 ? unbalanced : 0.0);
    StateWriter out;
    swing.time.save(&out);
    const std::string bytes = out.bytes();
    StateReader in(bytes);
    other.time.restore(&in);
    other.x = swing.x;
    for (int k = 0; k < 3; ++k) {
      swing.step(0.005);
      other.step(0.005);
      EXPECT_EQ(swing.x, other.x);
    }
  }
}

}  // namespace
}  // namespace palpate::solver::integrator_test

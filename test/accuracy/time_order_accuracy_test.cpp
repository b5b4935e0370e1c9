// SPDX-License-Identifier: GPL-3.0-or-later
// Order of the integrators in time: a soft block that swings, against the same with much shorter
// steps.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "palpate/fem/elasticity.h"
#include "palpate/solver/cholmod_solver.h"
#include "palpate/solver/integrator.h"
#include "palpate/solver/newton.h"
#include "support/accuracy_record.h"

namespace palpate {
namespace {

struct Damped {
  solver::RayleighDamping rayleigh;
  std::vector<material::PronyTerm> prony;
  const char* name;
};

constexpr double kDuration = 0.1;  // [s], a fifth of a swing

// Positions of a block that is held at the bottom, `steps` steps after a push to the side.
Points swing(const std::string& integrator, int steps, const Damped& damped) {
  const mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.05, 0.05, 0.1), Eigen::Vector3i(1, 1, 4));
  fem::Composition composition = fem::Composition::uniform(
      material::makeMaterial("neo_hookean", {{"young_modulus", {5e3}}, {"poisson_ratio", {0.4}}}));
  composition.solids[0].prony = damped.prony;
  const auto body = fem::makeElasticity("anp", mesh, composition);
  fem::FreeMask free = fem::FreeMask::Ones(3, mesh.numPoints());
  Points v = Points::Zero(3, mesh.numPoints());
  for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
    const double height = mesh.points(2, i) / 0.1;
    if (height == 0.0) free.col(i).setZero();
    v(0, i) = 0.4 * (1.0 - std::cos(0.5 * M_PI * height));
  }
  solver::Integrator time(integrator, body->masses(), damped.rayleigh);
  solver::Potential potential{body.get(), {}, free, 1.0};
  time.addTerms(&potential);
  body->relax(mesh.points);
  time.start(mesh.points, v);
  solver::Newton newton(body->makeMatrix(), std::make_unique<solver::CholmodSolver>());
  const double h = kDuration / steps;
  Points x = mesh.points, g;
  for (int k = 0; k < steps; ++k) {
    time.beginStep(h, &potential);
    body->beginStep(h);
    solver::NewtonSettings settings;
    settings.tolerance = 1e-11 + 1e-16 * body->masses().sum() / (h * h);  // above roundoff
    const solver::NewtonReport report = newton.minimize(potential, settings, &x);
    EXPECT_EQ(report.status, solver::SolveStatus::kConverged);
    body->gradient(x, &g);
    time.endStep(x, g);
    body->endStep(x);
  }
  return x;
}

void PrintTo(const Damped& damped, std::ostream* out) { *out << damped.name; }

// An order that is lost shows as 1. The next term of the error is a part h w of the first, w the
// block's frequency; the steps are chosen so that it is some hundredths.
constexpr double kMostOff = 0.1;

class TimeOrder : public ::testing::TestWithParam<Damped> {};

TEST_P(TimeOrder, IsThatOfTheIntegrator) {
  const Points reference = swing("bdf2", 6400, GetParam());
  const auto order = [&](const std::string& integrator, int steps) {
    const double coarse = (swing(integrator, steps, GetParam()) - reference).norm();
    const double fine = (swing(integrator, 2 * steps, GetParam()) - reference).norm();
    return std::log2(coarse / fine);
  };
  const auto record = [&](const std::string& integrator, int steps, double expected) {
    const double found = order(integrator, steps);
    test::recordAccuracy({"Order in time",
                          "block of 24 tetrahedra, " + std::to_string(steps) + " and " +
                              std::to_string(2 * steps) + " steps",
                          "anp", "order of " + integrator + ", " + GetParam().name, found, expected,
                          "theory: Hairer, Wanner 1996", std::abs(found - expected), kMostOff});
  };
  record("backward_euler", 800, 1.0);
  record("bdf2", 200, 2.0);
}

INSTANTIATE_TEST_SUITE_P(Damping, TimeOrder,
                         ::testing::Values(Damped{{}, {}, "undamped"},
                                           Damped{{5.0, 2e-3}, {}, "Rayleigh"},
                                           Damped{{}, {{0.3, 0.05}}, "Prony"}),
                         [](const auto& damped) { return damped.param.name; });

}  // namespace
}  // namespace palpate

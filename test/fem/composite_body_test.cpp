// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of several solids, and of solids that remember.
#include <gtest/gtest.h>

#include <cmath>

#include "palpate/fem/elasticity.h"
#include "palpate/solver/static_solver.h"
#include "support/random.h"

namespace palpate::fem::composite_body_test {
namespace {

material::Solid solid(double young_modulus, double poisson_ratio) {
  return {material::makeMaterial("neo_hookean", {{"young_modulus", {young_modulus}},
                                                 {"poisson_ratio", {poisson_ratio}}}),
          1000.0,
          {}};
}

// Two layers, z < 0.5 and z > 0.5, of a unit cube.
TetMesh layers(const std::string& element) {
  return meshFor(element, mesh::boxMesh(Vec3::Ones(), Eigen::Vector3i(3, 3, 4)));
}

Composition twoLayers(const TetMesh& mesh) {
  Composition composition{{solid(1e3, 0.499), solid(1e5, 0.3)}, {}, {}};
  for (Eigen::Index e = 0; e < mesh.numTets(); ++e) {
    double z = 0.0;
    for (int a = 0; a < 4; ++a) z += mesh.points(2, mesh.tets(a, e)) / 4.0;
    composition.solid_of.push_back(z < 0.5 ? 0 : 1);
  }
  return composition;
}

class Layers : public ::testing::TestWithParam<std::string> {
 protected:
  TetMesh mesh = layers(GetParam());
  Composition composition = twoLayers(mesh);
  std::unique_ptr<Elasticity> body = makeElasticity(GetParam(), mesh, composition);
};
INSTANTIATE_TEST_SUITE_P(Elements, Layers, ::testing::ValuesIn(elementNames()),
                         [](const auto& element) { return element.param; });

// Confined layers in series: each is strained alone, by a piecewise linear displacement that every
// element can represent. Pressures that were averaged across the interface would spoil it.
TEST_P(Layers, InSeriesCarryTheSameStress) {
  FreeMask free = FreeMask::Zero(3, mesh.numPoints());
  for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
    if (mesh.points(2, i) > 0.0 && mesh.points(2, i) < 1.0) free(2, i) = 1.0;
  }
  Points x = mesh.points;
  const solver::StaticReport report = solver::solveStatic(
      {body.get(), {}, free, 1.0},
      [&](double s) -> Points {
        Points moved = mesh.points;
        moved.row(2) *= 1.0 - 0.01 * s;
        return moved;
      },
      {1, 1e-12, 50}, &x);
  ASSERT_EQ(report.status, solver::SolveStatus::kConverged);
  Points g;
  body->gradient(x, &g);
  double bottom = 0.0;
  for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
    if (mesh.points(2, i) == 0.0) bottom += g(2, i);
  }
  const auto states =
      body->states(x, {{0, Eigen::Vector4d::Constant(0.25)},
                       {static_cast<int>(mesh.numTets()) - 1, Eigen::Vector4d::Constant(0.25)}});
  EXPECT_NE(composition.solid_of.front(), composition.solid_of.back());
  const double lower = states[0].cauchy_stress(2, 2), upper = states[1].cauchy_stress(2, 2);
  EXPECT_NEAR(lower, upper, 1e-8 * std::abs(upper));
  EXPECT_NEAR(-bottom, upper, 1e-8 * std::abs(upper));  // on an area that stays 1 m^2
  EXPECT_NEAR(0.5 * (states[0].F(2, 2) + states[1].F(2, 2)), 0.99, 1e-10);
}

TEST_P(Layers, EnergiesOfTheSolidsSumToTheBodys) {
  test::Random random;
  const Points x = mesh.points + random.points(mesh.numPoints(), 0.01);
  const Eigen::VectorXd energies = body->energyBySolid(x);
  ASSERT_EQ(energies.size(), 2);
  EXPECT_NEAR(energies.sum(), body->energy(x), 1e-12 * energies.sum());
  EXPECT_GT(energies.minCoeff(), 0.0);
}

TEST_P(Layers, DerivativesHoldWhileTheBodyRelaxes) {
  composition.solids[1].prony = {{0.3, 0.1}, {0.2, 1.0}};
  body = makeElasticity(GetParam(), mesh, composition);
  ASSERT_TRUE(body->viscous());
  test::Random random;
  body->relax(mesh.points);
  body->beginStep(0.05);
  body->endStep(mesh.points + random.points(mesh.numPoints(), 0.01));
  body->beginStep(0.02);
  const Points x = mesh.points + random.points(mesh.numPoints(), 0.01);
  Points g, plus, minus, Kd;
  EXPECT_DOUBLE_EQ(body->gradient(x, &g), body->energy(x));
  Stiffness K = body->makeMatrix();
  body->hessian(x, Tangent::kExact, &K);
  for (int trial = 0; trial < 5; ++trial) {
    const Points d = random.points(mesh.numPoints(), 1.0);
    constexpr double h = 1e-6;
    const double slope = (body->energy(x + h * d) - body->energy(x - h * d)) / (2.0 * h);
    EXPECT_NEAR(g.cwiseProduct(d).sum(), slope, 1e-6 * g.norm() * d.norm());
    K.multiply(d, &Kd);
    body->gradient(x + h * d, &plus);
    body->gradient(x - h * d, &minus);
    EXPECT_LT((Kd - (plus - minus) / (2.0 * h)).norm(), 1e-6 * Kd.norm());
  }
}

TEST_P(Layers, RelaxationKeepsTheSumOfTheSeries) {
  composition.solids[0].prony = composition.solids[1].prony = {{0.3, 0.1}, {0.2, 1.0}};
  composition.solids[0].law = composition.solids[1].law;
  body = makeElasticity(GetParam(), mesh, composition);
  Points sheared = mesh.points;  // a simple shear is all distortion
  sheared.row(0) += 0.2 * mesh.points.row(2);
  const auto force = [&] {
    Points g;
    body->gradient(sheared, &g);
    double top = 0.0;
    for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
      if (mesh.points(2, i) == 1.0) top += g(0, i);
    }
    return top;
  };
  body->relax(mesh.points);
  body->beginStep(1e-9);  // a sudden load
  const double sudden = force();
  body->endStep(sheared);
  for (const double t : {0.05, 0.25, 1.0}) {
    body->beginStep(t);
    const auto before = body->saveViscousState();
    EXPECT_NEAR(force() / sudden, 0.5 + 0.3 * std::exp(-t / 0.1) + 0.2 * std::exp(-t), 1e-7);
    body->endStep(sheared);
    body->restoreViscousState(before.get());  // every time from the sudden load on
  }
  body->relax(sheared);
  EXPECT_NEAR(force() / sudden, 0.5, 1e-9);
}

}  // namespace
}  // namespace palpate::fem::composite_body_test

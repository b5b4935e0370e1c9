// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/static_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "palpate/fem/elasticity.h"
#include "palpate/fem/loads.h"
#include "palpate/mesh/selection.h"
#include "support/random.h"
#include "support/uniaxial.h"

namespace palpate::solver::static_solver_test {
namespace {

// Laws for which `right` holds.
template <class Right>
std::vector<std::string> lawsWith(Right&& right) {
  std::vector<std::string> names;
  for (const std::string& name : material::materialNames()) {
    if (right(material::makeMaterial(name, material::exampleConstants(name))))
      names.push_back(name);
  }
  return names;
}
bool isIsotropic(const material::Material& law) { return !material::needsFibres(law); }

struct Body {
  mesh::TetMesh mesh;
  material::Material law;
  std::unique_ptr<fem::Elasticity> elasticity;
  Potential potential;

  Body(mesh::TetMesh m, const std::string& name)
      : mesh(std::move(m)),
        law(material::makeMaterial(name, material::exampleConstants(name))),
        elasticity(fem::makeElasticity("tet4", mesh, composition())),
        potential{elasticity.get(), {}, fem::FreeMask::Ones(3, mesh.numPoints())} {}

  // Fibres along x.
  fem::Composition composition() const {
    fem::Composition c = fem::Composition::uniform(law);
    if (material::needsFibres(law)) c.frames.assign(mesh.tets.cols(), Mat3::Identity());
    return c;
  }
  void hold(int axis, double at, int component) {
    for (int i : mesh::selectPoints(mesh.points, mesh::PlaneRegion{axis, at, -1.0})) {
      potential.free(component, i) = 0.0;
    }
  }
  // Sum of the support's forces on a plane.
  Vec3 reaction(const Points& x, int axis, double at) const {
    Points g;
    potential.gradient(x, &g);
    Vec3 sum = Vec3::Zero();
    for (int i : mesh::selectPoints(mesh.points, mesh::PlaneRegion{axis, at, -1.0})) {
      sum += g.col(i);
    }
    return sum;
  }
};

class EveryLaw : public ::testing::TestWithParam<std::string> {};
class EveryIsotropicLaw : public EveryLaw {};
class EveryFrameIndifferentLaw : public EveryLaw {};

TEST_P(EveryIsotropicLaw, UniaxialStretchOfABar) {
  for (const double lambda : {0.8, 1.3}) {
    Body bar(mesh::boxMesh(Vec3(0.1, 0.1, 0.3), Eigen::Vector3i(2, 2, 6)), GetParam());
    bar.hold(0, 0.0, 0);
    bar.hold(1, 0.0, 1);
    bar.hold(2, 0.0, 2);
    bar.hold(2, 0.3, 2);
    Points x = bar.mesh.points;
    const StaticReport report = solveStatic(
        bar.potential,
        [&](double s) {
          Points target = bar.mesh.points;
          target.row(2) *= 1.0 + s * (lambda - 1.0);
          return target;
        },
        {4, 1e-11, 50}, &x);
    ASSERT_EQ(report.status, SolveStatus::kConverged);
    double transverse;
    const double P = test::uniaxialStress(bar.law, lambda, &transverse);
    EXPECT_NEAR(bar.reaction(x, 2, 0.3).z(), P * 0.01, 1e-8 * std::abs(P * 0.01));
    EXPECT_NEAR(x.row(0).maxCoeff(), 0.1 * transverse, 1e-9);
    EXPECT_LT((bar.reaction(x, 2, 0.3) + bar.reaction(x, 2, 0.0)).norm(), 1e-9 * std::abs(P));
  }
}

TEST_P(EveryLaw, PatchTest) {
  test::Random random;
  mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.1, 0.1, 0.1), Eigen::Vector3i::Constant(4));
  fem::FreeMask free = fem::FreeMask::Zero(3, mesh.numPoints());
  for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
    const Vec3 p = mesh.points.col(i);
    if ((p.array() <= 0.0).any() || (p.array() >= 0.1).any()) continue;
    mesh.points.col(i) += random.vector(0.004);
    free.col(i).setOnes();
  }
  Body body(mesh, GetParam());
  body.potential.free = free;
  const Mat3 F = Mat3::Identity() + random.matrix(0.1);
  Points x = mesh.points;
  const StaticReport report = solveStatic(
      body.potential,
      [&](double s) { return ((1.0 - s) * Mat3::Identity() + s * F) * mesh.points; },
      {1, 1e-13, 50}, &x);
  ASSERT_EQ(report.status, SolveStatus::kConverged);
  EXPECT_LT((x - F * mesh.points).cwiseAbs().maxCoeff(), 1e-12 * 0.1);
}

TEST_P(EveryFrameIndifferentLaw, QuarterTurnIsFreeOfStress) {
  Body body(mesh::boxMesh(Vec3(0.1, 0.1, 0.2), Eigen::Vector3i(2, 2, 4)), GetParam());
  for (int c = 0; c < 3; ++c) body.hold(2, 0.0, c);
  Points x = body.mesh.points;
  const Vec3 axis = Vec3(1.0, 2.0, 0.5).normalized();
  const auto turned = [&](double s) {
    return Points(Eigen::AngleAxisd(s * M_PI / 2, axis).toRotationMatrix() * body.mesh.points);
  };
  const StaticReport report = solveStatic(body.potential, turned, {12, 1e-9, 50}, &x);
  ASSERT_EQ(report.status, SolveStatus::kConverged);
  EXPECT_LT((x - turned(1.0)).cwiseAbs().maxCoeff(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Laws, EveryLaw, ::testing::ValuesIn(material::materialNames()),
                         [](const auto& law) { return law.param; });
INSTANTIATE_TEST_SUITE_P(Laws, EveryIsotropicLaw, ::testing::ValuesIn(lawsWith(isIsotropic)),
                         [](const auto& law) { return law.param; });
INSTANTIATE_TEST_SUITE_P(Laws, EveryFrameIndifferentLaw,
                         ::testing::ValuesIn(lawsWith(material::isFrameIndifferent)),
                         [](const auto& law) { return law.param; });

TEST(StaticSolver, BalancesTractionAndPressureByTheSupports) {
  Body body(mesh::boxMesh(Vec3(0.1, 0.1, 0.1), Eigen::Vector3i::Constant(3)), "neo_hookean");
  for (int c = 0; c < 3; ++c) body.hold(2, 0.0, c);
  const auto top =
      fem::selectFaces(mesh::boundaryTriangles(body.mesh.tets),
                       mesh::selectPoints(body.mesh.points, mesh::PlaneRegion{2, 0.1, -1.0}));
  fem::DeadLoad pull(fem::tractionForces(body.mesh.points, top, Vec3(100.0, 0.0, 50.0)));
  fem::FollowerPressure press(top, 200.0);
  body.potential.terms = {&pull, &press};
  Points x = body.mesh.points;
  const StaticReport report = solveStatic(
      body.potential,
      [&](double s) {
        pull.setFactor(s);
        press.setFactor(s);
        return body.mesh.points;
      },
      {2, 1e-10, 50}, &x);
  ASSERT_EQ(report.status, SolveStatus::kConverged);
  Points loads = Points::Zero(3, x.cols());
  pull.addGradient(x, &loads);
  press.addGradient(x, &loads);
  EXPECT_LT((body.reaction(x, 2, 0.0) - loads.rowwise().sum()).norm(), 1e-8);
  EXPECT_GT(loads.norm(), 0.1);
}

TEST(StaticSolver, CutsLoadStepsThatAreTooLarge) {
  Body bar(mesh::boxMesh(Vec3(0.1, 0.1, 0.2), Eigen::Vector3i(2, 2, 4)), "neo_hookean");
  for (int c = 0; c < 3; ++c) {
    bar.hold(2, 0.0, c);
    bar.hold(2, 0.2, c);
  }
  Points x = bar.mesh.points;
  const StaticReport report = solveStatic(
      bar.potential,
      [&](double s) {
        Points target = bar.mesh.points;
        for (Eigen::Index i = 0; i < target.cols(); ++i) {
          const double height = target(2, i) / 0.2;
          const Vec3 about(0.05, 0.05, 0.0);
          target.col(i) =
              Eigen::AngleAxisd(M_PI * s * height, Vec3::UnitZ()) * (target.col(i) - about) + about;
          target(2, i) *= 1.0 - 0.4 * s;
        }
        return target;
      },
      {1, 1e-9, 8}, &x);
  EXPECT_EQ(report.status, SolveStatus::kConverged);
  EXPECT_GT(report.load_steps, 1);
  EXPECT_GT(bar.elasticity->minJacobian(x), 0.0);
}

TEST(StaticSolver, SaysHowFarItCame) {
  Body bar(mesh::boxMesh(Vec3(0.1, 0.1, 0.2), Eigen::Vector3i(1, 1, 2)), "neo_hookean");
  for (int c = 0; c < 3; ++c) {
    bar.hold(2, 0.0, c);
    bar.hold(2, 0.2, c);
  }
  Points x = bar.mesh.points;
  const StaticReport report = solveStatic(
      bar.potential,
      [&](double s) {
        Points target = bar.mesh.points;
        target.row(2) *= 1.0 - 1.2 * s;  // turned inside out from s = 1/1.2 on
        return target;
      },
      {10, 1e-9, 20}, &x);
  EXPECT_NE(report.status, SolveStatus::kConverged);
  EXPECT_GT(report.load_factor, 0.5);
  EXPECT_LT(report.load_factor, 1.0 / 1.2);
  EXPECT_TRUE(x.allFinite());
  EXPECT_GT(bar.elasticity->minJacobian(x), 0.0);
}

}  // namespace
}  // namespace palpate::solver::static_solver_test

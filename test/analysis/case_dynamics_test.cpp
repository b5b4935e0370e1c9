// SPDX-License-Identifier: GPL-3.0-or-later
// Dynamic cases are stepped as organs of scenes are, by all methods alike.
#include <gtest/gtest.h>

#include "palpate/analysis/case_solver.h"
#include "palpate/base/error.h"
#include "palpate/tissue/fem/fem_tissue.h"
#include "support/contains.h"

namespace palpate::analysis::case_dynamics_test {
namespace {

BoundaryCondition onPlane(double z) {
  BoundaryCondition b;
  mesh::PlaneRegion plane;
  plane.axis = 2;
  plane.at = z;
  b.select = plane;
  return b;
}

// A block of 4 x 4 x 8 cm that stands on its lower end, with a probe of the support there.
Case block() {
  Case c;
  c.mesh.box = BoxMesh{Vec3(0.04, 0.04, 0.08), Eigen::Vector3i(2, 2, 4)};
  c.material.law = "neo_hookean";
  c.material.constants = {{"young_modulus", {1.0e4}}, {"poisson_ratio", {0.4}}};
  c.boundary = {onPlane(0.0)};
  c.boundary[0].displacement = keys::PartialVec3{0.0, 0.0, 0.0};
  Probe support;
  support.name = "support";
  support.select = c.boundary[0].select;
  support.quantity = "reaction";
  c.probes = {support};
  return c;
}

DynamicAnalysis dynamic(const std::string& method) {
  DynamicAnalysis a;
  a.method = method;
  a.dt = 0.01;
  a.duration = 1.0;
  a.ramp_time = 0.1;
  a.tolerance = 1.0e-7;
  a.damping.mass = 40.0;
  return a;
}

// Its upper end is moved down by `depth` [m] and one side is pressed.
Case pressed(double depth) {
  Case c = block();
  c.boundary.push_back(onPlane(0.08));
  c.boundary[1].displacement = keys::PartialVec3{0.0, 0.0, -depth};
  mesh::BoxRegion side;
  side.min = Vec3(0.039, -1.0, -1.0);
  side.max = Vec3(0.041, 1.0, 1.0);
  c.boundary.emplace_back();
  c.boundary[2].select = side;
  c.boundary[2].pressure = 5.0e3 * depth;
  return c;
}

Vec3 supportAtEnd(const CaseOutcome& outcome) { return *outcome.result.probes.at(0).force; }

class CaseMethods : public ::testing::TestWithParam<std::string> {};

TEST_P(CaseMethods, ComesToRestWhereTheStaticAnalysisIs) {
  const bool linear = GetParam() == "linear_precomputed";
  Case c = pressed(linear ? 1.0e-5 : 0.004);
  c.analysis = StaticAnalysis();
  const CaseOutcome at_rest = solveCase(c, 1);
  ASSERT_TRUE(at_rest.converged);
  c.analysis = dynamic(GetParam());
  const CaseOutcome outcome = solveCase(c, 1);
  ASSERT_TRUE(outcome.converged) << outcome.result.status;
  EXPECT_EQ(outcome.history.rows.size(), 101u);
  const Vec3 expected = supportAtEnd(at_rest);
  EXPECT_LT((supportAtEnd(outcome) - expected).norm(), 1e-3 * expected.norm())
      << supportAtEnd(outcome).transpose() << " where " << expected.transpose() << " is right";
}

TEST_P(CaseMethods, GivesTheSameBitsWithTwoThreads) {
  Case c = pressed(0.004);
  DynamicAnalysis analysis = dynamic(GetParam());
  analysis.duration = 0.2;
  c.analysis = analysis;
  EXPECT_EQ(solveCase(c, 1).history.rows, solveCase(c, 2).history.rows);
}

INSTANTIATE_TEST_SUITE_P(All, CaseMethods, ::testing::ValuesIn(tissue::methodNames()),
                         [](const auto& method) { return method.param; });

// A block all of whose nodes are held and turned about an axis: the supports exert what keeps the
// masses on their circles, m w^2 r, whoever steps it.
TEST(CaseDynamics, SupportsOfATurningBlockHoldItsMassOnTheCircle) {
  for (const std::string method : {"implicit_pcg", "tled"}) {
    Case c = block();
    mesh::BoxRegion all;
    all.min = Vec3::Constant(-1.0);
    all.max = Vec3::Constant(1.0);
    c.boundary[0].select = all;
    c.boundary[0].displacement.reset();
    const double rate = 1.5, distance = 0.5;  // [rad/s], [m]
    c.boundary[0].rotation = Rotation{Vec3::UnitZ(), Vec3(0.02 + distance, 0.02, 0.0), 0.5 * rate};
    c.probes[0].select = all;
    DynamicAnalysis analysis = dynamic(method);
    analysis.damping.mass = 0.0;
    analysis.duration = analysis.ramp_time.emplace(0.5);
    c.analysis = analysis;
    const CaseOutcome outcome = solveCase(c, 1);
    ASSERT_TRUE(outcome.converged) << method;
    const double mass = 1000.0 * 0.04 * 0.04 * 0.08;
    const double expected = mass * rate * rate * distance;
    EXPECT_NEAR(supportAtEnd(outcome).norm(), expected, 1e-3 * expected) << method;
  }
}

TEST(CaseDynamics, WhatAMethodDoesNotTakeIsRefusedByTheCase) {
  Case c = block();
  c.file = "block.yaml";
  DynamicAnalysis analysis = dynamic("tled");
  analysis.integrator = "bdf2";
  c.analysis = analysis;
  try {
    solveCase(c, 1);
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_TRUE(test::contains(error.what(), "block.yaml"));
    EXPECT_TRUE(test::contains(error.what(), "analysis"));
    EXPECT_TRUE(test::contains(error.what(), "bdf2"));
  }
}

TEST(CaseDynamics, AutoSaysWhatItTook) {
  Case c = block();
  DynamicAnalysis analysis = dynamic("auto");
  analysis.duration = 0.02;
  c.analysis = analysis;
  const CaseOutcome outcome = solveCase(c, 1);
  ASSERT_EQ(outcome.notes.size(), 1u);
  EXPECT_TRUE(test::contains(outcome.notes[0], "method auto takes"));
}

}  // namespace
}  // namespace palpate::analysis::case_dynamics_test

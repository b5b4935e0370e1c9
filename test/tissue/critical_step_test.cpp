// SPDX-License-Identifier: GPL-3.0-or-later
#include "tissue/methods/explicit/critical_step.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <utility>

#include "liver_slab.h"

namespace palpate::tissue::critical_step_test {
namespace {

struct Body {
  test::LiverSlab slab;
  std::unique_ptr<fem::Elasticity> elasticity;

  explicit Body(const std::string& element, double poisson_ratio = 0.45)
      : slab("tled", Eigen::Vector3i(3, 3, 2), element) {
    const material::Material law = test::LiverSlab::liver("stable_neo_hookean", poisson_ratio);
    elasticity = fem::makeElasticity(element, slab.mesh, fem::Composition::uniform(law, 1060.0));
  }

  // 2 / sqrt of the largest eigenvalue of M^-1 K at x, of the whole spectrum.
  double criticalStep(const Points& x) {
    fem::Stiffness K = elasticity->makeMatrix();
    elasticity->hessian(x, fem::Tangent::kExact, &K);
    const Eigen::VectorXd& m = elasticity->masses();
    const Points scale = slab.free * m.cwiseSqrt().cwiseInverse().asDiagonal();
    Eigen::MatrixXd A(x.size(), x.size());
    Points unit = Points::Zero(3, x.cols()), column;
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      unit.data()[k] = scale.data()[k];
      K.multiply(unit, &column);
      A.col(k) = Eigen::Map<const Eigen::VectorXd>(column.data(), x.size())
                     .cwiseProduct(Eigen::Map<const Eigen::VectorXd>(scale.data(), x.size()));
      unit.data()[k] = 0.0;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A, Eigen::EigenvaluesOnly);
    return 2.0 / std::sqrt(solver.eigenvalues().maxCoeff());
  }
};

class EveryElement : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(CriticalStep, EveryElement, ::testing::ValuesIn(fem::elementNames()),
                         [](const auto& kind) { return kind.param; });

TEST_P(EveryElement, IsThatOfTheWholeSpectrumAtRestAndNeverLonger) {
  for (const double poisson_ratio : {0.3, 0.49}) {
    Body body(GetParam(), poisson_ratio);
    CriticalStep critical(body.elasticity.get(), body.slab.free);
    critical.begin(body.slab.mesh.points);
    const double right = body.criticalStep(body.slab.mesh.points);
    EXPECT_LE(critical.seconds(), right * (1.0 + 1e-9));
    EXPECT_GT(critical.seconds(), 0.97 * right);
  }
}

// A bulge that grows in ten cycles: the stiffest mode moves to its elements.
TEST_P(EveryElement, FollowsABodyThatStiffens) {
  Body body(GetParam());
  CriticalStep critical(body.elasticity.get(), body.slab.free);
  const Points& X = body.slab.mesh.points;
  critical.begin(X);
  const double rest = critical.seconds();
  Points x = X;
  for (int k = 1; k <= 10; ++k) {
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      const double distance = std::hypot(X(0, i) - 0.033, X(1, i) - 0.033);
      x(2, i) = X(2, i) * (1.0 + 0.06 * k * std::exp(-std::pow(distance / 0.03, 2)));
    }
    critical.follow(x);
  }
  const double right = body.criticalStep(x);
  EXPECT_LT(right, 0.95 * rest);
  EXPECT_NEAR(critical.seconds(), right, 0.08 * right);
  critical.follow(X);
  EXPECT_EQ(critical.seconds(), rest);
}

// At rest they are slack, and their stiffness is none; where they swing it is. What is taut in each
// second step needs steps that are shorter by sqrt(2).
TEST_P(EveryElement, TakesFibresThatResistTensionOnlyForTaut) {
  Body body(GetParam());
  const material::Constants myocardium{{"a", {1500.0}},  {"b", {1.0}},   {"af", {4e4}},
                                       {"bf", {1.5}},    {"as", {2e4}},  {"bs", {1.2}},
                                       {"afs", {500.0}}, {"bfs", {1.1}}, {"kappa", {1e4}}};
  const material::Constants artery{{"mu", {2e3}},          {"k1", {3e4, 2e4}},
                                   {"k2", {0.8, 1.2}},     {"dispersion", {0.0, 0.2}},
                                   {"angle", {0.7, -0.5}}, {"kappa", {1e4}}};
  for (const auto& [law, constants] :
       {std::pair{"holzapfel_ogden", myocardium}, std::pair{"holzapfel_gasser_ogden", artery}}) {
    fem::Composition composition =
        fem::Composition::uniform(material::makeMaterial(law, constants), 1060.0);
    composition.frames.assign(static_cast<std::size_t>(body.slab.mesh.numTets()), Mat3::Identity());
    body.elasticity = fem::makeElasticity(GetParam(), body.slab.mesh, composition);
    const Points& X = body.slab.mesh.points;
    CriticalStep critical(body.elasticity.get(), body.slab.free);
    critical.begin(X);
    const Vec3 squeezed(1.0 + 1e-6, 1.0 + 1e-6, 1.0 - 2e-6);  // all fibres lie across z
    const double taut = body.criticalStep(squeezed.asDiagonal() * X);
    const double longest = taut / std::sqrt(2.0);
    EXPECT_LE(CriticalStep::kSafety * critical.seconds(), longest) << law;
    EXPECT_GT(CriticalStep::kSafety * critical.seconds(), 0.95 * longest) << law;
    EXPECT_LT(critical.seconds(), 0.9 * body.criticalStep(X)) << law;
  }
}

TEST(CriticalStep, IsEndlessWhereNothingIsFree) {
  Body body("tet4");
  CriticalStep critical(body.elasticity.get(), fem::FreeMask::Zero(3, body.slab.mesh.numPoints()));
  critical.begin(body.slab.mesh.points);
  critical.follow(2.0 * body.slab.mesh.points);
  EXPECT_EQ(critical.seconds(), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace palpate::tissue::critical_step_test

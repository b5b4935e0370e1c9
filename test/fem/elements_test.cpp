// SPDX-License-Identifier: GPL-3.0-or-later
// What every element must obey with every law; a new one gets these tests by being listed.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <tuple>

#include "palpate/fem/elasticity.h"
#include "support/law_response.h"
#include "support/random.h"

namespace palpate::fem::elements_test {
namespace {

// A box whose inner nodes are moved, so that no two elements are alike; the middles of the edges
// of 10-node tetrahedra too, which bends them.
TetMesh distortedBox(const std::string& element, test::Random* random, bool bent = true) {
  const int cells = isQuadratic(element) ? 2 : 3;
  TetMesh mesh = mesh::boxMesh(Vec3(0.1, 0.12, 0.09), Eigen::Vector3i::Constant(cells));
  const Vec3 high = mesh.points.rowwise().maxCoeff();
  const auto shake = [&](double size) {
    for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
      const Vec3 p = mesh.points.col(i);
      if ((p.array() <= 0.0).any() || (p.array() >= high.array()).any()) continue;
      mesh.points.col(i) += random->vector(size * 0.1 / cells);
    }
  };
  shake(0.1);
  mesh = meshFor(element, mesh);
  if (mesh.quadratic() && bent) shake(0.03);
  return mesh;
}

Eigen::MatrixXd dense(const Stiffness& K) {
  const Eigen::Index n = 3 * K.numNodes();
  Eigen::MatrixXd matrix(n, n);
  Points e = Points::Zero(3, K.numNodes()), Ke;
  for (Eigen::Index i = 0; i < n; ++i) {
    e(i % 3, i / 3) = 1.0;
    K.multiply(e, &Ke);
    matrix.col(i) = Eigen::Map<const Eigen::VectorXd>(Ke.data(), n);
    e(i % 3, i / 3) = 0.0;
  }
  return matrix;
}

class EveryElement : public ::testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  std::string element() const { return std::get<0>(GetParam()); }
  // Fibres along no axis of the mesh.
  Composition composition() const {
    const std::string law = std::get<1>(GetParam());
    Composition made =
        Composition::uniform(material::makeMaterial(law, material::exampleConstants(law)));
    const Mat3 frame = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    if (material::needsFibres(made.solids[0].law)) made.frames.assign(mesh.numTets(), frame);
    return made;
  }
  bool frameIndifferent() const {
    return material::isFrameIndifferent(composition().solids[0].law);
  }
  bool onTheBoundary(Eigen::Index i) const {
    const Vec3 p = mesh.points.col(i), high = mesh.points.rowwise().maxCoeff();
    return (p.array() <= 0.0).any() || (p.array() >= high.array()).any();
  }

  test::Random random;
  TetMesh mesh = distortedBox(element(), &random);
  std::unique_ptr<Elasticity> body = makeElasticity(element(), mesh, composition());
};

TEST_P(EveryElement, GradientIsThatOfTheEnergy) {
  const Points x = mesh.points + random.points(mesh.numPoints(), 0.001);
  Points g;
  EXPECT_DOUBLE_EQ(body->gradient(x, &g), body->energy(x));
  constexpr double h = 1e-6;
  for (int trial = 0; trial < 5; ++trial) {
    const Points d = random.points(mesh.numPoints(), 1.0);
    const double slope = (body->energy(x + h * d) - body->energy(x - h * d)) / (2.0 * h);
    EXPECT_NEAR(g.cwiseProduct(d).sum(), slope, 1e-6 * g.norm() * d.norm());
  }
}

TEST_P(EveryElement, HessianIsThatOfTheGradient) {
  const Points x = mesh.points + random.points(mesh.numPoints(), 0.001);
  Stiffness K = body->makeMatrix();
  body->hessian(x, Tangent::kExact, &K);
  constexpr double h = 1e-7;
  for (int trial = 0; trial < 5; ++trial) {
    const Points d = random.points(mesh.numPoints(), 1.0);
    Points Kd, plus, minus;
    K.multiply(d, &Kd);
    body->gradient(x + h * d, &plus);
    body->gradient(x - h * d, &minus);
    EXPECT_LT((Kd - (plus - minus) / (2.0 * h)).norm(), 1e-6 * Kd.norm());
  }
}

TEST_P(EveryElement, ProjectedHessianIsPositiveSemidefinite) {
  const Points x = 0.85 * mesh.points + random.points(mesh.numPoints(), 0.002);
  Stiffness K = body->makeMatrix();
  body->hessian(x, Tangent::kProjected, &K);
  const Eigen::MatrixXd matrix = dense(K);
  EXPECT_LT((matrix - matrix.transpose()).norm(), 1e-12 * matrix.norm());
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
  EXPECT_GT(eigenvalues.minCoeff(), -1e-8 * eigenvalues.maxCoeff());
}

// A law for small rotations is only free to shift.
TEST_P(EveryElement, RigidMotionIsFree) {
  const double angle = frameIndifferent() ? M_PI / 2 : 0.0;
  const Mat3 R = Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Points x = (R * mesh.points).colwise() + Vec3(0.3, -0.2, 0.1);
  Points g, stretched;
  body->gradient(x, &g);
  body->gradient(1.01 * mesh.points, &stretched);
  EXPECT_LT(g.norm(), 1e-11 * stretched.norm() / 0.01);
}

// The patch test: a homogeneous deformation of the boundary is in equilibrium inside. With straight
// edges; the rule of four points does not integrate bent ones exactly.
TEST_P(EveryElement, HomogeneousStretchIsInEquilibriumInside) {
  mesh = distortedBox(element(), &random, false);
  body = makeElasticity(element(), mesh, composition());
  const Mat3 F = Mat3::Identity() + random.matrix(0.1);
  Points g;
  body->gradient(F * mesh.points, &g);
  for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
    if (onTheBoundary(i)) continue;
    EXPECT_LT(g.col(i).norm(), 1e-11 * g.norm());
  }
}

TEST_P(EveryElement, HomogeneousStretchHasTheStressOfTheLaw) {
  const Mat3 F = Mat3::Identity() + random.matrix(0.1);
  const Composition solid = composition();
  const Mat3 Q = solid.frames.empty() ? Mat3::Identity() : solid.frames[0];
  const Mat3 P = test::firstPiolaKirchhoff(solid.solids[0].law, F * Q);
  const Mat3 sigma = P * (F * Q).transpose() / F.determinant();
  for (int e = 0; e < 5; ++e) {
    const auto state =
        body->states(F * mesh.points, {{e, Eigen::Vector4d(0.4, 0.3, 0.2, 0.1)}}).front();
    EXPECT_LT((state.F - F).norm(), 1e-12);
    EXPECT_LT((state.cauchy_stress - sigma).norm(), 1e-11 * sigma.norm());
  }
}

TEST_P(EveryElement, ForcesSumToZero) {
  Points g;
  body->gradient(mesh.points + random.points(mesh.numPoints(), 0.001), &g);
  EXPECT_LT(g.rowwise().sum().norm(), 1e-13 * g.norm());
}

TEST_P(EveryElement, ThreadsDoNotChangeABit) {
  const Points x = mesh.points + random.points(mesh.numPoints(), 0.001);
  ThreadPool pool(3);
  const auto threaded = makeElasticity(element(), mesh, composition(), &pool);
  Points g, g_threaded;
  EXPECT_EQ(body->gradient(x, &g), threaded->gradient(x, &g_threaded));
  EXPECT_EQ(g, g_threaded);
  Stiffness K = body->makeMatrix(), K_threaded = body->makeMatrix();
  body->hessian(x, Tangent::kExact, &K);
  threaded->hessian(x, Tangent::kExact, &K_threaded);
  Points y, y_threaded;
  K.multiply(x, &y);
  K_threaded.multiply(x, &y_threaded);
  EXPECT_EQ(y, y_threaded);
}

std::string label(const ::testing::TestParamInfo<std::tuple<std::string, std::string>>& info) {
  return std::get<0>(info.param) + "_" + std::get<1>(info.param);
}
INSTANTIATE_TEST_SUITE_P(EveryLaw, EveryElement,
                         ::testing::Combine(::testing::ValuesIn(elementNames()),
                                            ::testing::ValuesIn(material::materialNames())),
                         label);

const Composition kNeoHookean = Composition::uniform(
    material::makeMaterial("neo_hookean", material::exampleConstants("neo_hookean")), 1050.0);

std::string refusal(const std::string& element, const TetMesh& mesh,
                    const Composition& composition) {
  try {
    makeElasticity(element, mesh, composition);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(MakeElasticity, RefusesWhatItCannotUse) {
  TetMesh mesh = mesh::boxMesh(Vec3::Ones(), Eigen::Vector3i::Ones());
  EXPECT_NE(refusal("tet5", mesh, kNeoHookean).find("must be one of"), std::string::npos);
  EXPECT_NE(refusal("tet10", mesh, kNeoHookean).find("10-node"), std::string::npos);
  EXPECT_NE(refusal("anp", mesh::toQuadratic(mesh), kNeoHookean).find("4-node"), std::string::npos);
  std::swap(mesh.tets(0, 3), mesh.tets(1, 3));
  EXPECT_NE(refusal("anp", mesh, kNeoHookean).find("tetrahedron 4"), std::string::npos);
}

TEST(MakeElasticity, RefusesEdgesBentTooFar) {
  TetMesh mesh = mesh::toQuadratic(mesh::boxMesh(Vec3::Ones(), Eigen::Vector3i::Ones()));
  // The middle of an edge of tetrahedron 3 near one of the edge's ends.
  mesh.points.col(mesh.midnodes(0, 2)) =
      0.9 * mesh.points.col(mesh.tets(0, 2)) + 0.1 * mesh.points.col(mesh.tets(1, 2));
  EXPECT_NE(refusal("tet10", mesh, kNeoHookean).find("where its edges are bent"),
            std::string::npos);
}

TEST(Masses, SumToTheBodyAndArePositive) {
  const TetMesh box = mesh::boxMesh(Vec3(0.1, 0.2, 0.3), Eigen::Vector3i(2, 3, 4));
  for (const std::string& element : elementNames()) {
    const auto body = makeElasticity(element, meshFor(element, box), kNeoHookean);
    EXPECT_NEAR(body->volume(), 0.006, 1e-15) << element;
    EXPECT_NEAR(body->masses().sum(), 6.3, 1e-12) << element;
    EXPECT_NEAR(body->loadWeights().sum(), 6.3, 1e-12) << element;
    EXPECT_GT(body->masses().minCoeff(), 0.0) << element;
  }
}

}  // namespace
}  // namespace palpate::fem::elements_test

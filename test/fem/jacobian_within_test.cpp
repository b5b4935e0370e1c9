// SPDX-License-Identifier: GPL-3.0-or-later
// det F between the integration points of quadratic tetrahedra.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "palpate/fem/elasticity.h"
#include "support/random.h"

namespace palpate::fem::jacobian_within_test {
namespace {

struct Body {
  explicit Body(const std::string& element, int cells = 1)
      : mesh(
            meshFor(element, mesh::boxMesh(Vec3(0.1, 0.1, 0.1), Eigen::Vector3i::Constant(cells)))),
        elasticity(makeElasticity(element, mesh,
                                  Composition::uniform(material::makeMaterial(
                                      "neo_hookean", material::exampleConstants("neo_hookean"))))) {
  }

  // Least det F at `count` random places.
  double sampled(const Points& x, int count, test::Random* random) const {
    std::vector<mesh::Location> places;
    for (int k = 0; k < count; ++k) {
      const Vec3 r = 0.5 * (random->vector(1.0) + Vec3::Ones());
      Eigen::Vector4d w(0.0, r[0], r[1], r[2]);
      w.array() += 1e-3;
      w = w.array().pow(2.0);
      places.push_back({k % static_cast<int>(mesh.numTets()), w / w.sum()});
    }
    double least = 1e9;
    for (const PointState& state : elasticity->states(x, places)) {
      least = std::min(least, state.F.determinant());
    }
    return least;
  }

  TetMesh mesh;
  std::unique_ptr<Elasticity> elasticity;
};

TEST(JacobianWithin, IsThatOfLinearElements) {
  const Body body("tet4", 2);
  test::Random random(1);
  Points x = body.mesh.points;
  for (Eigen::Index i = 0; i < x.cols(); ++i) x.col(i) += random.vector(0.02);
  EXPECT_EQ(body.elasticity->minJacobianWithin(x), body.elasticity->minJacobian(x));
}

TEST(JacobianWithin, IsExactWhereTheBodyIsAffine) {
  const Body body("tet10");
  const Mat3 R = Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  EXPECT_NEAR(body.elasticity->minJacobianWithin(R * body.mesh.points), 1.0, 1e-12);
  Points x = body.mesh.points;
  x.row(0) *= 0.5;
  EXPECT_NEAR(body.elasticity->minJacobianWithin(x), 0.5, 1e-12);
}

// Gradients of quadratic fields: a grid of sixths comes near to the least of many places.
TEST(JacobianWithin, FindsTheLeastOfManyPlaces) {
  const Body body("tet10");
  test::Random random(7);
  for (int trial = 0; trial < 20; ++trial) {
    Points x = body.mesh.points;
    for (Eigen::Index i = 0; i < x.cols(); ++i) x.col(i) += random.vector(0.01);
    const double within = body.elasticity->minJacobianWithin(x);
    const double sampled = body.sampled(x, 20000, &random);
    EXPECT_LT(within, sampled + 0.02) << trial;
    EXPECT_LE(within, body.elasticity->minJacobian(x)) << trial;
  }
}

// A node in the middle of an edge, moved along it past a quarter: the corner is turned over, and
// integration points are not.
TEST(JacobianWithin, SeesACornerCurledOver) {
  const Body body("tet10");
  Points x = body.mesh.points;
  const int corner = body.mesh.tets(0, 0), other = body.mesh.tets(1, 0),
            middle = body.mesh.midnodes(0, 0);
  x.col(middle) = 0.78 * x.col(corner) + 0.22 * x.col(other);
  EXPECT_GT(body.elasticity->minJacobian(x), 0.2);
  EXPECT_LT(body.elasticity->minJacobianWithin(x), -0.05);
}

}  // namespace
}  // namespace palpate::fem::jacobian_within_test

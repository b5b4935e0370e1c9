// SPDX-License-Identifier: GPL-3.0-or-later
// The tensor-mass model: the stiffness of linear tetrahedra at rest, and what turning does to it.
#include <gtest/gtest.h>

#include "support/random.h"
#include "tissue/models/tensor_mass/tensor_mass_elasticity.h"

namespace palpate::tissue::tensor_mass_test {
namespace {

class TensorMass : public ::testing::Test {
 protected:
  TensorMass() : mesh(mesh::boxMesh(Vec3(0.03, 0.04, 0.02), Eigen::Vector3i(2, 3, 2))) {
    test::Random random(3);
    const Points off = random.points(mesh.numPoints(), 0.001);
    mesh.points += off;
    law = fem::Composition::uniform(material::makeMaterial(
        "neo_hookean", {{"young_modulus", {8e3}}, {"poisson_ratio", {0.4}}}));
  }
  mesh::TetMesh mesh;
  fem::Composition law;
};

// All laws obey Hooke's at small strain, so that tangents at rest are the tensors.
TEST_F(TensorMass, HasTheStiffnessOfLinearTetrahedraAtRest) {
  TensorMassElasticity tensors(mesh, law);
  const auto elements = fem::makeElasticity("tet4", mesh, law);
  fem::Stiffness of_tensors = tensors.makeMatrix(), of_elements = elements->makeMatrix();
  tensors.hessian(mesh.points, fem::Tangent::kExact, &of_tensors);
  elements->hessian(mesh.points, fem::Tangent::kExact, &of_elements);
  for (unsigned seed = 0; seed < 4; ++seed) {
    const Points u = test::Random(seed).points(mesh.numPoints(), 0.01);
    Points by_tensors, by_elements, g;
    of_tensors.multiply(u, &by_tensors);
    of_elements.multiply(u, &by_elements);
    EXPECT_LT((by_tensors - by_elements).norm(), 1e-12 * by_elements.norm());
    const double energy = tensors.gradient(mesh.points + u, &g);
    EXPECT_LT((g - by_elements).norm(), 1e-12 * by_elements.norm());
    EXPECT_NEAR(energy, 0.5 * u.cwiseProduct(by_elements).sum(), 1e-12 * energy);
    EXPECT_NEAR(tensors.energyBySolid(mesh.points + u).sum(), energy, 1e-12 * energy);
    EXPECT_LT(g.rowwise().sum().norm(), 1e-12 * g.norm());
  }
}

TEST_F(TensorMass, StressIsHookes) {
  TensorMassElasticity tensors(mesh, law);
  const Mat3 F = Mat3::Identity() + test::Random(5).matrix(0.01);
  const Mat3 strain = 0.5 * (F + F.transpose()) - Mat3::Identity();
  const double mu = 8e3 / 2.8, lambda = 8e3 * 0.4 / (1.4 * 0.2);
  const fem::PointState state =
      tensors.states(F * mesh.points, {{4, Eigen::Vector4d::Constant(0.25)}}).front();
  const Mat3 stress = 2.0 * mu * strain + lambda * strain.trace() * Mat3::Identity();
  EXPECT_LT((state.cauchy_stress - stress).norm(), 1e-10 * stress.norm());
}

// What it is known for: a body that is turned as a whole would have a force of the square of the
// angle.
TEST_F(TensorMass, TakesATurnForAStrain) {
  TensorMassElasticity tensors(mesh, law);
  const auto norm = [&](double angle) {
    Points g;
    tensors.gradient(Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix() * mesh.points, &g);
    return g.norm();
  };
  EXPECT_NEAR(norm(0.2) / norm(0.1), 4.0, 0.05);
}

}  // namespace
}  // namespace palpate::tissue::tensor_mass_test

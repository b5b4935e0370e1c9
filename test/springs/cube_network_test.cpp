// SPDX-License-Identifier: GPL-3.0-or-later
// Lattices of cubes against a solid with Poisson's ratio 1/4.
#include <gtest/gtest.h>

#include <cmath>

#include "palpate/springs/network_modes.h"
#include "palpate/springs/network_statics.h"
#include "palpate/springs/spring_grids.h"

namespace palpate::springs::cube_network_test {
namespace {

constexpr double E = 100.0, kEdge = 0.25, kExact = 1e-10;

SpringNetwork cube(int cells, CubeDiagonals diagonals = CubeDiagonals::kFaces,
                   Constants constants = Constants::kCorrected) {
  return cubeNetwork(cubeSprings(E, kEdge, diagonals, constants), kEdge,
                     Eigen::Vector3i::Constant(cells), 1000.0);
}

struct Pulled {
  double force;            // over E A strain
  double poisson_ratio;    // mean over the points
  double worst_deviation;  // of a displacement from the uniform one, over the largest
};

// Pulled by `strain` along an axis; one side a direction is held, without friction.
Pulled pull(const SpringNetwork& network, int axis, double strain) {
  const Points& X = network.points;
  const double L = X.maxCoeff();
  NetworkLoads loads = noLoads(network);
  Points prescribed = Points::Zero(3, X.cols());
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    for (int c = 0; c < 3; ++c) {
      if (X(c, i) == 0.0) loads.free(c, i) = 0.0;
    }
    if (X(axis, i) == L) {
      loads.free(axis, i) = 0.0;
      prescribed(axis, i) = strain * L;
    }
  }
  const auto moved = linearDisplacements(network, X, loads, prescribed);
  if (!moved) return {0.0, 0.0, 1.0};
  const Eigen::VectorXd f =
      networkTangent(network, X) * Eigen::Map<const Eigen::VectorXd>(moved->data(), moved->size());
  double force = 0.0;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    if (X(axis, i) == L) force += f[3 * i + axis];
  }
  Points uniform = -0.25 * strain * X;
  uniform.row(axis) = strain * X.row(axis);
  const int side = (axis + 1) % 3;
  return {force / (E * L * L * strain), -moved->row(side).sum() / (strain * X.row(side).sum()),
          (*moved - uniform).cwiseAbs().maxCoeff() / (std::abs(strain) * L)};
}

TEST(CubeNetwork, PatchTest) {
  for (const int cells : {2, 5, 8}) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double strain : {1e-3, -1e-3}) {
        const Pulled pulled = pull(cube(cells), axis, strain);
        EXPECT_NEAR(pulled.force, 1.0, kExact) << cells << " " << axis;
        EXPECT_NEAR(pulled.poisson_ratio, 0.25, kExact) << cells << " " << axis;
        EXPECT_LT(pulled.worst_deviation, kExact) << cells << " " << axis;
      }
    }
  }
}

TEST(CubeNetwork, ThePrintedConstantsAreTwiceTooStiff) {
  const Pulled pulled = pull(cube(4, CubeDiagonals::kFaces, Constants::kPrinted), 2, 1e-3);
  EXPECT_NEAR(pulled.force, 2.0, kExact);
  EXPECT_NEAR(pulled.poisson_ratio, 0.25, kExact);
}

TEST(CubeNetwork, MassesAreThatOfTheBody) {
  const SpringNetwork network = cube(3);
  EXPECT_NO_THROW(checkNetwork(network));
  const double mass = 1000.0 * std::pow(3 * kEdge, 3);
  EXPECT_NEAR(network.masses.sum(), mass, 1e-13 * mass);
}

TEST(CubeNetwork, EdgesAndBodyDiagonalsHaveThreeMechanisms) {
  for (int cells = 1; cells <= 4; ++cells) {
    const NetworkModes body = networkModes(cube(cells, CubeDiagonals::kBody));
    const NetworkModes faces = networkModes(cube(cells, CubeDiagonals::kFaces));
    EXPECT_EQ(body.neutral, 6 + 3) << cells;
    EXPECT_EQ(faces.neutral, 6) << cells;
    EXPECT_EQ(body.falling + faces.falling, 0) << cells;
  }
}

// At finite strain the forces of the network are those of the linear one but for
// a part that grows with the strain.
TEST(CubeNetwork, NonlinearEquilibriumOfATwoPercentPull) {
  const SpringNetwork network = cube(3);
  for (const double strain : {0.02, -0.02}) {
    const double L = 3 * kEdge;
    NetworkLoads loads = noLoads(network);
    Points x = network.points;
    x.row(2) *= 1.0 + strain;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      for (int c = 0; c < 3; ++c) {
        if (network.points(c, i) == 0.0) loads.free(c, i) = 0.0;
      }
      if (network.points(2, i) == L) loads.free(2, i) = 0.0;
    }
    ASSERT_EQ(solveNetwork(network, loads, {1e-12}, &x).status, solver::SolveStatus::kConverged);
    const Points forces = networkForces(network, x);
    double pull = 0.0;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      if (network.points(2, i) == L) pull -= forces(2, i);
    }
    EXPECT_NEAR(pull / (E * L * L * strain), 1.0, 3 * std::abs(strain));
    EXPECT_NEAR((1.0 - x.row(0).maxCoeff() / L) / strain, 0.25, 3 * std::abs(strain));
  }
}

}  // namespace
}  // namespace palpate::springs::cube_network_test

// SPDX-License-Identifier: GPL-3.0-or-later
// Tensors and a linear rest that exchange forces and displacements once a cycle: how long cycles
// may be, and what is lost.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "hybrid_block.h"
#include "tissue/models/hybrid/hybrid_elasticity.h"

namespace palpate::tissue::hybrid_loop_test {
namespace {

using test::ballAt;
using test::difference;
using test::kStep;
using test::onTool;
using Block = test::HybridBlock;

// Of the loop's step h, without damping, modes go as r^2 (K + M/h^2) + r (S - 2 M/h^2) + M/h^2 = 0,
// K and M of the region, S of the rest at the border: |r| < 1 as long as K + 4 M/h^2 - S is
// positive definite.
double longestStepOfLoop(const Block& block) {
  const mesh::TetMesh& mesh = block.organ.mesh;
  const fem::Composition composition{{block.organ.solid}, {}, {}};
  const std::vector<int> region = mesh::selectTets(mesh, *block.organ.hybrid.region);
  HybridElasticity both(mesh, composition, region, block.organ.free, Vec3::Zero(),
                        std::vector<char>(static_cast<std::size_t>(mesh.numPoints()), 0));
  fem::Stiffness together = both.makeMatrix(), alone = both.makeMatrix();
  both.hessian(mesh.points, fem::Tangent::kExact, &together);
  both.beginLoop(mesh.points);
  both.hessian(mesh.points, fem::Tangent::kExact, &alone);
  std::vector<Eigen::Index> components;
  for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
    if (both.masses()[i] < 1e-8) continue;
    for (int k = 0; k < 3; ++k) {
      if (block.organ.free(k, i) != 0.0) components.push_back(3 * i + k);
    }
  }
  const auto size = static_cast<Eigen::Index>(components.size());
  Eigen::MatrixXd K(size, size), S(size, size), M = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index a = 0; a < size; ++a) {
    Points unit = Points::Zero(3, mesh.numPoints()), of_both, of_region;
    unit.data()[components[static_cast<std::size_t>(a)]] = 1.0;
    together.multiply(unit, &of_both);
    alone.multiply(unit, &of_region);
    M(a, a) = both.masses()[components[static_cast<std::size_t>(a)] / 3];
    for (Eigen::Index b = 0; b < size; ++b) {
      const Eigen::Index at = components[static_cast<std::size_t>(b)];
      K(b, a) = of_region.data()[at];
      S(b, a) = of_both.data()[at] - of_region.data()[at];
    }
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(S - K, M);
  return 2.0 / std::sqrt(modes.eigenvalues().maxCoeff());
}

TEST(HybridLoop, IsStableUpToAStepThatIsKnown) {
  Block block;
  block.settings.gravity.setZero();
  block.organ.damping = {0.0, 0.0};
  block.organ.hybrid.exchange = "loop";
  const double longest = longestStepOfLoop(block);
  block.settings.step = 0.9 * longest;  // what the scene would say
  std::printf("longest step of the loop: %.4f s\n", longest);
  for (const double h : {0.9 * longest, 1.1 * longest}) {
    const auto tissue = block.make("hybrid");
    Points x = tissue->positions();
    Eigen::Index at = 0;
    (x.colwise() - Vec3(0.03, 0.03, 0.03)).colwise().squaredNorm().minCoeff(&at);
    x.col(at) += Vec3(1e-4, 0.5e-4, 0.7e-4);
    tissue->setPositions(0, x, Points::Zero(3, x.cols()));
    double largest = 0.0;
    for (int k = 0; k < 150; ++k) {
      tissue->step({}, h);
      largest = (tissue->positions() - block.organ.mesh.points).cwiseAbs().maxCoeff();
      if (largest > 1e-3) break;
    }
    EXPECT_EQ(largest > 1e-3, h > longest) << h << " s: " << largest;
  }
}

// By dense eigenvalues and Lanczos' iteration; damping by mass makes it longer.
TEST(HybridLoop, RefusesStepsThatAreTooLong) {
  Block block;
  block.settings.gravity.setZero();
  block.organ.damping = {0.0, 0.0};
  block.organ.hybrid.exchange = "loop";
  const double longest = longestStepOfLoop(block);
  const auto refused = [&](double h) {
    block.settings.step = h;
    try {
      block.make("hybrid");
    } catch (const std::invalid_argument& error) {
      return std::string(error.what()).find("solver.step is") != std::string::npos;
    }
    return false;
  };
  EXPECT_FALSE(refused(0.999 * longest));
  EXPECT_TRUE(refused(1.001 * longest));
  block.organ.damping.mass = 0.5 / longest;
  // From h^2 (2/longest)^2 - 2 c h - 4 = 0, in units of the step without damping.
  const double damped = longest * (0.125 + std::sqrt(1.0 + 0.125 * 0.125));
  EXPECT_FALSE(refused(0.999 * damped));
  EXPECT_TRUE(refused(1.001 * damped));
}

// Where the tool touches the region, and where it touches the rest.
class HybridLoopAt : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Places, HybridLoopAt, ::testing::Values(0.025, 0.037));

TEST_P(HybridLoopAt, LagsAndComesToTheSameRest) {
  Block block;
  const auto together = block.make("hybrid");
  block.organ.hybrid.exchange = "loop";
  const double h = 0.5 * longestStepOfLoop(block);
  block.settings.step = h;
  const auto loop = block.make("hybrid");
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();
  double lag = 0.0, most = 0.0, loop_energy = 0.0, energy = 0.0;
  for (double t = 0.0; t < 2.5; t += h) {
    contact::Obstacle ball = ballAt(GetParam(), t);
    ball.X_WG_end = ballAt(GetParam(), t + h - kStep).X_WG_end;
    const TissueStep& of_loop = loop->step({ball}, h);
    const TissueStep& other = together->step({ball}, h);
    a = onTool(of_loop);
    b = onTool(other);
    loop_energy = of_loop.elastic_energy;
    energy = other.elastic_energy;
    lag = std::max(lag, (a - b).norm());
    most = std::max(most, b.norm());
  }
  std::printf(
      "loop in steps of %.4f s, touched at %.3f m: at most %.2g of %.3f N beside the other\n", h,
      GetParam(), lag, most);
  EXPECT_LT(lag, 0.2 * most);
  EXPECT_LT((a - b).norm(), 1e-5 * b.norm());
  EXPECT_LT(difference(loop->positions(), together->positions(), block.organ.mesh.points), 1e-5);
  EXPECT_NEAR(loop_energy, energy, 1e-5 * energy);
}

}  // namespace
}  // namespace palpate::tissue::hybrid_loop_test

// SPDX-License-Identifier: GPL-3.0-or-later
// A region of tensors joined with a linear rest that is solved for beforehand: both together are
// the whole body of tensors, wherever a tool touches and whatever holds it.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "hybrid_block.h"
#include "support/contains.h"
#include "tissue/models/tensor_mass/tensor_mass_elasticity.h"

namespace palpate::tissue::hybrid_test {
namespace {

using test::ballAt;
using test::difference;
using test::Held;
using test::hold;
using test::kAll;
using test::kHalf;
using test::kNone;
using test::kSize;
using test::kStep;
using test::onTool;
using Block = test::HybridBlock;

TEST(Hybrid, OfARegionOfNoneIsTheLinearOne) {
  Block block(kNone);
  const auto hybrid = block.make("hybrid");
  block.settings.method = "linear_precomputed";
  const auto linear = block.make("fem");
  EXPECT_LT(difference(hybrid->positions(), linear->positions(), block.organ.mesh.points), 1e-8);
  const Held a = hold(hybrid.get(), 0.03, 0.3), b = hold(linear.get(), 0.03, 0.3);
  EXPECT_GT(b.force.z(), 0.1);
  EXPECT_LT((a.force - b.force).norm(), 1e-6 * b.force.norm());
  EXPECT_LT((a.support - b.support).norm(), 1e-6 * b.support.norm());
  EXPECT_LT(difference(a.x, b.x, block.organ.mesh.points), 1e-6);
  EXPECT_NEAR(a.step.elastic_energy, b.step.elastic_energy, 1e-6 * b.step.elastic_energy);
}

TEST(Hybrid, OfARegionOfAllIsTheTensorMassModel) {
  const Block block(kAll);
  const auto hybrid = block.make("hybrid"), tensors = block.make("tensor_mass");
  EXPECT_LT(difference(hybrid->positions(), tensors->positions(), block.organ.mesh.points), 1e-8);
  for (int k = 0; k < 60; ++k) {
    const Vec3 a = onTool(hybrid->step({ballAt(0.02, k * kStep)}, kStep));
    const Vec3 b = onTool(tensors->step({ballAt(0.02, k * kStep)}, kStep));
    EXPECT_LT((a - b).norm(), 1e-8 * std::max(0.01, b.norm())) << k;
    EXPECT_LT(difference(hybrid->positions(), tensors->positions(), block.organ.mesh.points), 1e-8);
  }
}

// Where the tool touches the region, the rest, or both.
TEST(Hybrid, AtRestIsTheTensorMassModelWhereverItIsTouched) {
  const Block block;
  const Points& X = block.organ.mesh.points;
  for (const double x : {0.015, 0.03, 0.045}) {
    const auto hybrid = block.make("hybrid"), tensors = block.make("tensor_mass");
    EXPECT_LT(difference(hybrid->positions(), tensors->positions(), X), 1e-6);
    const Held a = hold(hybrid.get(), x, 2.5), b = hold(tensors.get(), x, 2.5);
    EXPECT_GT(b.force.z(), 0.1);
    EXPECT_LT((a.force - b.force).norm(), 1e-6 * b.force.norm()) << x;
    EXPECT_LT((a.support - b.support).norm(), 1e-6 * b.support.norm()) << x;
    EXPECT_LT(difference(a.x, b.x, X), 1e-6) << x;
    EXPECT_NEAR(a.step.elastic_energy, b.step.elastic_energy, 1e-6 * b.step.elastic_energy);
    EXPECT_NEAR(a.step.min_jacobian, b.step.min_jacobian, 1e-6);
  }
}

// Every point of the rest is in balance with tensors of the whole, while the region moves.
TEST(Hybrid, BalancesTheRestInEveryCycle) {
  Block block;
  block.organ.damping = {1.0, 0.0};
  const auto hybrid = block.make("hybrid");
  const mesh::TetMesh& mesh = block.organ.mesh;
  TensorMassElasticity whole(mesh, fem::Composition{{block.organ.solid}, {}, {}});
  std::vector<char> of_region(static_cast<std::size_t>(mesh.numPoints()), 0);
  for (const int t : mesh::selectTets(mesh, kHalf)) {
    for (int k = 0; k < 4; ++k) of_region[static_cast<std::size_t>(mesh.tets(k, t))] = 1;
  }
  Points g;
  for (int k = 0; k < 40; ++k) {
    const TissueStep& step = hybrid->step({ballAt(0.025, k * kStep)}, kStep);
    ASSERT_TRUE(step.ok());
    const Vec3 sum = step.support_force + step.gravity_force + step.inertia_force - onTool(step);
    EXPECT_LT(sum.norm(), std::sqrt(3.0 * static_cast<double>(mesh.numPoints())) * step.tolerance);
    const Points x = hybrid->positions();
    whole.gradient(x, &g);
    g -= block.settings.gravity * whole.loadWeights().transpose();
    double square = 0.0;
    for (Eigen::Index i = 0; i < g.cols(); ++i) {
      const bool near =
          (x.col(i).head<2>() - Vec3(0.025, 0.03, 0.0).head<2>()).norm() < 0.015 && x(2, i) > 0.02;
      if (!of_region[static_cast<std::size_t>(i)] && !near) {
        square += g.col(i).cwiseProduct(block.organ.free.col(i)).squaredNorm();
      }
    }
    EXPECT_LT(std::sqrt(square), 1e-7) << k;  // [N], of 0.3 on the tool and 1.1 of weight
  }
}

// Springs and a motion on the rest, which keeps such points.
TEST(Hybrid, KnowsSupportsThatMoveAndGive) {
  Block block;
  const Points X = block.organ.mesh.points;
  block.organ.free.setOnes();
  block.settings.gravity = Vec3(0.0, 0.0, -2.0);
  block.around = [&](Surroundings* s) {
    std::vector<int> carried, sprung;
    for (int i = 0; i < static_cast<int>(X.cols()); ++i) {
      if (X(0, i) >= kSize.x() - 1e-9) carried.push_back(i);
      if (X(2, i) <= 0.0 && X(0, i) < kSize.x() - 1e-9) sprung.push_back(i);
    }
    for (const int i : carried) s->free.col(i).setZero();
    MotionTable way{{0.0, 0.2}, Points::Zero(3, 2), false};
    way.at(1, 1) = 0.001;
    s->carried.push_back({carried, Motion(way)});
    SpringSupport springs;
    springs.nodes = sprung;
    springs.constants.normal = springs.constants.tangential = 2e5;
    s->springs.push_back(springs);
  };
  const auto hybrid = block.make("hybrid"), tensors = block.make("tensor_mass");
  EXPECT_LT(difference(hybrid->positions(), tensors->positions(), X), 1e-6);
  for (int k = 0; k < 250; ++k) {
    const TissueStep& step = hybrid->step({}, kStep);
    ASSERT_TRUE(step.ok());
    ASSERT_TRUE(tensors->step({}, kStep).ok());
    EXPECT_LT((step.support_force + step.gravity_force + step.inertia_force).norm(),
              std::sqrt(3.0 * static_cast<double>(X.cols())) * step.tolerance);
  }
  EXPECT_GT((hybrid->positions() - X).row(1).maxCoeff(), 0.001 - 1e-9);
  EXPECT_LT(difference(hybrid->positions(), tensors->positions(), X), 1e-6);
}

TEST(Hybrid, RefusesWhatItDoesNotKnow) {
  const auto refusal = [](const std::function<void(Block*)>& change) {
    Block block;
    change(&block);
    try {
      block.make("hybrid");
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  using test::contains;
  EXPECT_TRUE(contains(refusal([](Block* b) { b->organ.hybrid.region.reset(); }), "hybrid.region"));
  EXPECT_TRUE(contains(refusal([](Block* b) { b->settings.needles = true; }), "needle"));
  EXPECT_TRUE(contains(refusal([](Block* b) { b->settings.method = "tled"; }), "method = tled"));
  EXPECT_TRUE(
      contains(refusal([](Block* b) { b->organ.damping.stiffness = 0.01; }), "damping.stiffness"));
  EXPECT_TRUE(contains(refusal([](Block* b) { b->organ.free.setOnes(); }), "translation"));
  EXPECT_TRUE(contains(refusal([](Block* b) {
                         b->settings.gravity.setZero();
                         b->organ.free.setOnes();
                         b->organ.hybrid.region = kNone;
                       }),
                       "has no tetrahedron"));
  EXPECT_TRUE(contains(refusal([](Block* b) { b->organ.solid.prony = {{0.3, 1.0}}; }), "viscous"));
  EXPECT_TRUE(contains(refusal([](Block* b) {
                         b->organ.hybrid.exchange = "loop";
                         b->organ.free.row(1).setZero();
                       }),
                       "monolithic"));
  EXPECT_TRUE(contains(refusal([](Block* b) {
                         b->organ.mesh = mesh::boxMesh(kSize, Eigen::Vector3i(22, 22, 12));
                         b->organ.free = fem::FreeMask::Ones(3, b->organ.mesh.numPoints());
                         b->settings.gravity.setZero();
                       }),
                       "1500"));
}

}  // namespace
}  // namespace palpate::tissue::hybrid_test

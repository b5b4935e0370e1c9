// SPDX-License-Identifier: GPL-3.0-or-later
// What the force is worth on meshes that adapt, and which they are.
#include <gtest/gtest.h>

#include <cmath>

#include "adaptive_slab.h"
#include "support/contains.h"

namespace palpate::tissue::adaptive_mesh_test {
namespace {

using test::AdaptiveSlab;
using test::Ball;
using test::kStep;
using test::onTool;

// The reported error estimate against the deviation of the force from that of a much finer mesh.
TEST(AdaptiveMesh, SaysWhatOfTheForceIsTheMeshs) {
  struct Held {
    double force, error;
  };
  const auto press = [](const AdaptiveSlab& slab, bool adapts) {
    const auto tissue =
        adapts ? slab.make() : makeFemTissue(slab.mesh, slab.composition, slab.free, slab.settings);
    Ball ball(Vec3(0.05, 0.05, 0.052));
    Held held{};
    for (int k = 0; k < 50; ++k) {
      const TissueStep& step =
          tissue->step(ball.to(Vec3(0.05, 0.05, 0.052 - 0.0003 * std::min(k, 40))), kStep);
      held = {onTool(step).norm(), step.mesh_error};
    }
    return held;
  };
  const auto slabOf = [](const Eigen::Vector3i& cells, double finest) {
    AdaptiveSlab slab("anp", cells);
    slab.settings.integrator = "static";
    slab.adapt.finest = finest;
    return slab;
  };
  const Held fine = press(slabOf({8, 8, 4}, 0.0016), true);
  const double limit = fine.force - fine.error;
  EXPECT_LT(fine.error, 0.06 * fine.force);
  double before = 1e3;
  for (const double finest : {0.0, 0.008, 0.005, 0.003}) {
    const Held held = press(slabOf({8, 8, 4}, finest), finest > 0.0);
    const double error = held.force - limit;
    EXPECT_LT(held.error, before) << finest;
    EXPECT_GT(held.error, 0.5 * error) << finest << " " << held.force << " " << limit;
    EXPECT_LT(held.error, 2.0 * error) << finest << " " << held.force << " " << limit;
    before = held.error;
  }
}

// Supports of middle nodes are their own, not those of adjacent corners.
TEST(AdaptiveMesh, KeepsTheMaskOfMiddleNodes) {
  AdaptiveSlab slab("tet10");
  slab.settings.gravity = Vec3(0.0, 0.0, -9.81);
  for (const int i : slab.mesh.midnodes.reshaped()) slab.free.col(i).setOnes();
  const auto adaptive = slab.make();
  const auto fixed = makeFemTissue(slab.mesh, slab.composition, slab.free, slab.settings);
  const Points X = adaptive->cells(0).points, x = adaptive->positions();
  ASSERT_EQ(x.cols(), fixed->positions().cols());
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    Eigen::Index same = 0;
    (slab.mesh.points.colwise() - X.col(i)).colwise().squaredNorm().minCoeff(&same);
    EXPECT_LT((x.col(i) - fixed->positions().col(same)).norm(), 1e-9);
  }
}

// Quadratic elements near the limit from coarser meshes, and say how near.
TEST(AdaptiveMesh, ComesNearTheSameForceWithEveryElement) {
  struct Held {
    double force, error;
  };
  const auto hold = [](const char* element, double finest) {
    AdaptiveSlab slab(element);
    slab.settings.integrator = "static";
    slab.adapt.finest = finest;
    const auto tissue = slab.make();
    Ball ball(Vec3(0.05, 0.05, 0.052));
    Held held{};
    for (int k = 0; k < 45; ++k) {
      const TissueStep& step =
          tissue->step(ball.to(Vec3(0.05, 0.05, 0.052 - 0.0003 * std::min(k, 40))), kStep);
      held = {onTool(step).norm(), step.mesh_error};
    }
    return held;
  };
  const Held coarse = hold("tet10", 0.0105), fine = hold("tet10", 0.007);
  const Held other = hold("anp", 0.0025);
  EXPECT_LT(fine.force, coarse.force);
  EXPECT_LT(fine.error, coarse.error);
  EXPECT_NEAR(fine.force - fine.error, other.force - other.error, 0.03 * fine.force);
}

// Coarser under load, as fine as asked for without; the report has the edge length in effect.
TEST(AdaptiveMesh, IsCoarserAtAnotherPace) {
  AdaptiveSlab slab;
  const auto tissue = slab.make();
  Ball ball(Vec3(0.05, 0.05, 0.0505));
  const auto after = [&](double coarsening) {
    tissue->setMeshPace({false, coarsening});
    double edge = 0.0;
    for (int k = 0; k < 40; ++k) {
      edge = tissue->step(ball.to(Vec3(0.05, 0.05, 0.0505)), kStep).finest_edge;
    }
    EXPECT_EQ(edge, coarsening * slab.adapt.finest);
    return tissue->positions().cols();
  };
  const Eigen::Index fine = after(1.0), coarse = after(2.0);
  EXPECT_LT(coarse, 0.8 * static_cast<double>(fine));
  EXPECT_EQ(after(1.0), fine);
}

// A replay uses a mesh in a certain cycle, a live node once it is there.
TEST(AdaptiveMesh, IsUsedWhenItIsReady) {
  const AdaptiveSlab slab;
  const auto firstCycle = [&](bool when_ready) {
    const auto tissue = slab.make();  // without a thread for tasks a mesh is ready when asked
    tissue->setMeshPace({when_ready, 1.0});
    const Eigen::Index coarse = tissue->positions().cols();
    Ball ball(Vec3(0.05, 0.05, 0.0505));
    int cycles = 0;
    while (tissue->positions().cols() == coarse && cycles < 100) {
      tissue->step(ball.to(Vec3(0.05, 0.05, 0.0505)), kStep);
      ++cycles;
    }
    return cycles;
  };
  EXPECT_EQ(firstCycle(false), 1 + static_cast<int>(std::ceil(kBackgroundTime / kStep - 1e-6)));
  EXPECT_EQ(firstCycle(true), 2);
}

// A tool that is there all of a sudden asks for more than one change may do.
TEST(AdaptiveMesh, SpreadsWorkOverSeveralChanges) {
  AdaptiveSlab slab;
  slab.adapt.finest = 0.0008;
  ThreadPool pool(2);
  const auto tissue = slab.make(), other = slab.make(&pool);
  Ball ball(Vec3(0.05, 0.05, 0.0485)), same = ball;
  std::vector<Eigen::Index> nodes;
  for (int k = 0; k < 60; ++k) {
    tissue->step(ball.to(Vec3(0.05, 0.05, 0.0485)), kStep);
    other->step(same.to(Vec3(0.05, 0.05, 0.0485)), kStep);
    const Eigen::Index now = tissue->positions().cols();
    ASSERT_EQ(other->positions(), tissue->positions());
    if (nodes.empty() || nodes.back() != now) nodes.push_back(now);
    if (k == 20) {
      other->restore(tissue->state());
    }
  }
  EXPECT_GT(nodes.size(), 2u);
  EXPECT_EQ(tissue->surfaceState(0).revision,
            other->surfaceState(0).revision - 1);  // of the restored state
  // As fine in the end as was asked for.
  const mesh::CellMesh cells = tissue->cells(0);
  const Points& x = tissue->positions();
  double longest = 0.0;
  for (Eigen::Index t = 0; t < cells.cells.cols(); ++t) {
    Vec3 middle = Vec3::Zero();
    for (int a = 0; a < 4; ++a) middle += 0.25 * x.col(cells.cells(a, t));
    if ((middle - Vec3(0.05, 0.05, 0.0485)).norm() > 0.01 + kFineDistance * slab.adapt.finest) {
      continue;
    }
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < a; ++b) {
        longest = std::max(
            longest,
            (cells.points.col(cells.cells(a, t)) - cells.points.col(cells.cells(b, t))).norm());
      }
    }
  }
  EXPECT_LE(longest, 1.6 * slab.adapt.finest);
}

std::string refusal(const AdaptiveSlab& slab) {
  try {
    slab.make();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(AdaptiveMesh, RefusesWhatItCannotDo) {
  AdaptiveSlab slab;
  slab.settings.method = "linear_precomputed";
  EXPECT_TRUE(test::contains(refusal(slab), "method = linear_precomputed"));
  AdaptiveSlab quadratic("tet10");
  EXPECT_EQ(refusal(quadratic), "");
  quadratic.mesh.points.col(quadratic.mesh.midnodes(0, 0)) += Vec3(1e-4, 0.0, 1e-4);
  EXPECT_TRUE(test::contains(refusal(quadratic), "bent edge"));
}

}  // namespace
}  // namespace palpate::tissue::adaptive_mesh_test

// SPDX-License-Identifier: GPL-3.0-or-later
// What is made beside the cycles for a mesh that is taken into use later.
#include "tissue/fem/next_mesh.h"

#include <gtest/gtest.h>

#include "adaptive_slab.h"

namespace palpate::tissue {
namespace {

using test::AdaptiveSlab;
using test::Ball;
constexpr double kStep = test::kStep;

// Methods that keep a factor save its matrix, of nine numbers a block.
class NextMeshOf : public ::testing::TestWithParam<const char*> {
 protected:
  static std::size_t sizeOf(const FemOrgan& organ) { return organ.state().bytes.size(); }
  static std::size_t factorOf(const FemOrgan& organ) {
    return 9 * sizeof(double) * static_cast<std::size_t>(organ.body().x.cols());
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, NextMeshOf, ::testing::Values("lbfgs", "implicit_async"),
                         [](const auto& method) { return std::string(method.param); });

TEST_P(NextMeshOf, IsPreparedByTheTimeThatItIsTaken) {
  AdaptiveSlab slab("tet4");
  slab.settings.method = GetParam();
  slab.settings.step = kStep;
  NextMesh next(slab.mesh, slab.composition, slab.free, slab.settings, slab.adapt, nullptr);
  const std::unique_ptr<FemOrgan> coarse = next.make();
  next.setCoarse(coarse.get());
  coarse->settle();

  const auto goOn = [&](const FemOrgan& old, const Vec3& tool, FemOrgan* on_coarse) {
    ToolDistance tools(1e-4, 0.01);
    Ball ball(tool);
    tools.look({ball.to(tool)}, 0.0, old.body().x, 0.0);
    next.begin(old.body().x, tools);
    NextMesh::Result made = next.take();
    EXPECT_NE(made.change, nullptr);
    FemOrgan& organ = made.organ ? *made.organ : *on_coarse;
    const std::unique_ptr<FemOrgan> unprepared = next.make();
    EXPECT_GT(sizeOf(organ), sizeOf(*unprepared) + factorOf(organ));
    organ.goOnFrom(old, *made.change);
    EXPECT_GT(sizeOf(organ), sizeOf(*unprepared) + factorOf(organ));
    return std::move(made.organ);
  };
  std::unique_ptr<FemOrgan> fine = goOn(*coarse, Vec3(0.05, 0.05, 0.06), nullptr);
  ASSERT_NE(fine, nullptr);
  EXPECT_GT(fine->body().x.cols(), coarse->body().x.cols());
  EXPECT_EQ(goOn(*fine, Vec3(0.05, 0.05, 10.0), coarse.get()), nullptr);
}

}  // namespace
}  // namespace palpate::tissue

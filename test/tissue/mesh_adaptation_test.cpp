// SPDX-License-Identifier: GPL-3.0-or-later
// Background task that prepares an adapted mesh for later use.
#include "tissue/adaptation/mesh_adaptation.h"

#include <gtest/gtest.h>

#include "adaptive_slab.h"

namespace palpate::tissue::mesh_adaptation_test {
namespace {

using test::AdaptiveSlab;
using test::Ball;
constexpr double kStep = test::kStep;

// Methods that keep a factor save its matrix, of nine numbers a block.
class MeshAdaptationOf : public ::testing::TestWithParam<const char*> {
 protected:
  static std::size_t sizeOf(const FemOrgan& organ) { return organ.state().bytes.size(); }
  static std::size_t factorOf(const FemOrgan& organ) {
    return 9 * sizeof(double) * static_cast<std::size_t>(organ.body().x.cols());
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, MeshAdaptationOf, ::testing::Values("lbfgs", "implicit_async"),
                         [](const auto& method) { return std::string(method.param); });

TEST_P(MeshAdaptationOf, IsPreparedByTheTimeThatItIsTaken) {
  AdaptiveSlab slab("tet4");
  slab.settings.method = GetParam();
  slab.settings.step = kStep;
  MeshAdaptation next(slab.mesh, slab.composition, slab.free, slab.settings, slab.adapt, nullptr);
  const std::unique_ptr<FemOrgan> coarse = next.make();
  next.setCoarse(coarse.get());
  coarse->findEquilibrium();

  const auto goOn = [&](const FemOrgan& old, const Vec3& tool, FemOrgan* on_coarse) {
    ToolDistance tools(1e-4, 0.01);
    Ball ball(tool);
    tools.look({ball.to(tool)}, 0.0, old.body().x, 0.0);
    next.begin(old.body().x, tools, slab.adapt.finest, kStep);
    MeshAdaptation::Result made = next.take();
    EXPECT_NE(made.change, nullptr);
    FemOrgan& organ = made.organ ? *made.organ : *on_coarse;
    const std::unique_ptr<FemOrgan> unprepared = next.make();
    EXPECT_GT(sizeOf(organ), sizeOf(*unprepared) + factorOf(organ));
    organ.goOnFrom(old, *made.change);
    EXPECT_GT(sizeOf(organ), sizeOf(*unprepared) + factorOf(organ));
    return std::move(made.organ);
  };
  std::unique_ptr<FemOrgan> fine = goOn(*coarse, Vec3(0.05, 0.05, 0.05), nullptr);
  ASSERT_NE(fine, nullptr);
  EXPECT_GT(fine->body().x.cols(), coarse->body().x.cols());
  EXPECT_EQ(goOn(*fine, Vec3(0.05, 0.05, 10.0), coarse.get()), nullptr);
}

// A process that goes on from a state has a coarse body that never touched anything.
TEST_P(MeshAdaptationOf, IsPreparedTheSameWhateverTheBodyTouched) {
  AdaptiveSlab slab("tet4");
  slab.settings.method = GetParam();
  MeshAdaptation next(slab.mesh, slab.composition, slab.free, slab.settings, slab.adapt, nullptr);
  const std::unique_ptr<FemOrgan> touched = next.make(), other = next.make();
  touched->findEquilibrium();
  other->findEquilibrium();
  const Vec3 above(0.05, 0.05, 0.0505);
  Ball ball(above), later(above);
  for (int k = 1; k < 4; ++k) {
    touched->begin(ball.to(above - Vec3(0.0, 0.0, 0.001 * k)), kStep);
    touched->stepAlone(kStep);
  }
  EXPECT_FALSE(touched->report().contacts.empty());
  const Points x = other->body().x;
  touched->prepareAt(x, kStep);
  other->prepareAt(x, kStep);
  const auto obstacles = later.to(above - Vec3(0.0, 0.0, 0.002));
  for (FemOrgan* organ : {touched.get(), other.get()}) {
    organ->begin(obstacles, kStep);
    organ->stepAlone(kStep);
    EXPECT_TRUE(organ->report().ok());
  }
  EXPECT_EQ(touched->body().x, other->body().x);
}

// It sags by its weight as the coarse one does, from where little is left to its own rest, which is
// lower, for a finer mesh is softer.
class RefinedOrgan : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Elements, RefinedOrgan, ::testing::Values("tet4", "tet10"),
                         [](const auto& element) { return std::string(element.param); });

TEST_P(RefinedOrgan, ResetsToTheEquilibriumOfTheCoarseOne) {
  const bool quadratic = std::string(GetParam()) == "tet10";
  AdaptiveSlab slab(GetParam(), quadratic ? Eigen::Vector3i(2, 2, 1) : Eigen::Vector3i(4, 4, 2));
  slab.adapt.finest = quadratic ? 0.025 : 0.015;
  slab.settings.gravity = Vec3(0.0, 0.0, -9.81);
  slab.settings.mass_damping = 60.0;
  slab.composition = fem::Composition::uniform(
      material::makeMaterial("st_venant_kirchhoff",
                             {{"young_modulus", {6.0e3}}, {"poisson_ratio", {0.3}}}),
      1060.0);
  MeshAdaptation next(slab.mesh, slab.composition, slab.free, slab.settings, slab.adapt, nullptr);
  const std::unique_ptr<FemOrgan> coarse = next.make();
  next.setCoarse(coarse.get());
  coarse->findEquilibrium();
  ToolDistance tools(1e-4, 0.01);
  Ball ball(Vec3(0.05, 0.05, 0.05));
  tools.look({ball.to(Vec3(0.05, 0.05, 0.05))}, 0.0, coarse->body().x, 0.0);
  next.begin(coarse->body().x, tools, slab.adapt.finest, kStep);
  const std::unique_ptr<FemOrgan> fine = std::move(next.take().organ);
  ASSERT_NE(fine, nullptr);
  const Points& X = fine->body().mesh.points;
  const double sag = (coarse->equilibrium() - coarse->body().mesh.points).cwiseAbs().maxCoeff();
  EXPECT_GT(sag, 5e-4);
  EXPECT_NEAR((fine->equilibrium() - X).cwiseAbs().maxCoeff(), sag, 1e-12);
  // As the coarse one has it there, by the shape functions of its elements.
  const FemBody &of_coarse = coarse->body(), &of_fine = fine->body();
  EXPECT_NEAR(of_fine.elasticity->energy(fine->equilibrium()),
              of_coarse.elasticity->energy(coarse->equilibrium()),
              1e-2 * of_coarse.elasticity->energy(coarse->equilibrium()));

  Points x = X;
  x.row(2) *= -1.0;  // through the plane that holds it
  fine->setPositions(0, x, Points::Zero(3, x.cols()));
  int k = 0;
  do {
    fine->begin({}, kStep);
    fine->stepAlone(kStep);
  } while (fine->report().recovery != static_cast<int>(Recovery::kPutBack) && ++k < 2000);
  EXPECT_LT(k, 2000);
  EXPECT_EQ(fine->body().x, fine->equilibrium());
  for (k = 0; !fine->report().slept && k < 2000; ++k) {
    fine->begin({}, kStep);
    fine->stepAlone(kStep);
  }
  EXPECT_TRUE(fine->report().slept);
  const Points& rest = fine->body().x;
  EXPECT_LT((rest - fine->equilibrium()).norm(), 0.25 * (rest - X).norm());
}

// While a helper makes the next mesh, or prepares the coarse one.
TEST_P(MeshAdaptationOf, EndsWithItsTissue) {
  AdaptiveSlab slab("tet4");
  slab.settings.method = GetParam();
  ThreadPool pool(2);
  for (int cycles = 0; cycles < 8; ++cycles) {
    const auto tissue = slab.make(&pool);
    const Vec3 near(0.05, 0.05, 0.052), far(0.05, 0.05, 1.0);
    Ball ball(near);
    const Eigen::Index coarse = tissue->positions().cols();
    while (tissue->positions().cols() == coarse) tissue->step(ball.to(near), kStep);
    for (int k = 0; k <= cycles; ++k) tissue->step(ball.to(far), kStep);
  }
}

}  // namespace
}  // namespace palpate::tissue::mesh_adaptation_test

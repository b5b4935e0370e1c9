// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/fem/islands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "support/contains.h"

namespace palpate::tissue::islands_test {
namespace {

using instrument::Geometry;
using instrument::Sphere;

constexpr double kStep = 0.01;

// Two slabs 60 x 60 x 40 mm, 40 mm apart along x, on one table; the left one is softer.
struct TwoSlabs {
  mesh::TetMesh mesh;
  fem::Composition composition;
  fem::FreeMask free;
  FemSettings settings;

  TwoSlabs() {
    mesh = mesh::boxMesh(Vec3(0.06, 0.06, 0.04), Eigen::Vector3i(5, 5, 3));
    const Eigen::Index n = mesh.numPoints(), m = mesh.numTets();
    mesh.points.conservativeResize(3, 2 * n);
    mesh.points.rightCols(n) = mesh.points.leftCols(n).colwise() + Vec3(0.1, 0.0, 0.0);
    mesh.tets.conservativeResize(4, 2 * m);
    mesh.tets.rightCols(m) = mesh.tets.leftCols(m).array() + static_cast<int>(n);
    for (const double young : {6.0e3, 12.0e3}) {
      composition.solids.push_back(
          {material::makeMaterial("stable_neo_hookean",
                                  {{"young_modulus", {young}}, {"poisson_ratio", {0.45}}}),
           1060.0,
           {}});
    }
    composition.solid_of.assign(2 * m, 0);
    std::fill(composition.solid_of.begin() + m, composition.solid_of.end(), 1);
    free = fem::FreeMask::Ones(3, 2 * n);
    for (Eigen::Index i = 0; i < 2 * n; ++i) {
      if (mesh.points(2, i) == 0.0) free.col(i).setZero();
    }
    settings.gravity = Vec3(0.0, 0.0, -9.81);
    settings.sample_spacing = 0.005;
    settings.mass_damping = 5.0;
  }
  std::unique_ptr<TissueModel> make(bool islands) {
    settings.skip.islands = islands;
    return makeIslands(mesh, composition, free, settings);
  }
};

// A ball over the middle of the right slab, down 10 mm and up.
contact::Obstacle ballAt(double t) {
  static const Geometry ball = Sphere{0.01};
  const auto at = [](double s) {
    const double down = std::min(0.02 * s, 0.012) - std::max(0.02 * (s - 0.8), 0.0);
    return poseFromXyzRpy(Vec3(0.13, 0.03, 0.052 - down), Vec3::Zero());
  };
  return {&ball, 0, at(t), at(t + kStep)};
}

Vec3 onTool(const TissueStep& step) {
  Vec3 sum = Vec3::Zero();
  for (const TissueContact& c : step.contacts) sum += c.force_W;
  return sum;
}

TEST(Islands, AreTheOnePieceWithinTolerance) {
  TwoSlabs slabs;
  const auto islands = slabs.make(true), one = slabs.make(false);
  EXPECT_EQ(islands->surfaceState(0).triangles, one->surfaceState(0).triangles);
  EXPECT_EQ(islands->cells(0).points, one->cells(0).points);
  double peak = 0.0, difference = 0.0, apart = 0.0;
  for (int k = 0; k < 150; ++k) {
    const TissueStep& a = islands->step({ballAt(kStep * k)}, kStep);
    const TissueStep& b = one->step({ballAt(kStep * k)}, kStep);
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_LE(a.residual, a.tolerance);
    const Vec3 sum = a.support_force + a.gravity_force + a.inertia_force - onTool(a);
    EXPECT_LE(sum.norm(), std::sqrt(slabs.mesh.numPoints()) * a.tolerance + 1e-9);
    EXPECT_NEAR(a.elastic_energy, b.elastic_energy, 2e-3 * b.elastic_energy + 1e-9);
    EXPECT_NEAR(a.min_jacobian, b.min_jacobian, 2e-3);
    peak = std::max(peak, onTool(b).norm());
    difference = std::max(difference, (onTool(a) - onTool(b)).norm());
    apart = std::max(apart, (islands->positions() - one->positions()).cwiseAbs().maxCoeff());
  }
  EXPECT_GT(peak, 0.2);
  EXPECT_LT(difference, 2e-3 * peak);
  EXPECT_LT(apart, 2e-5);
}

TEST(Islands, OneSleepsWhileTheOtherIsPressed) {
  TwoSlabs slabs;
  const auto tissue = slabs.make(true);
  const Points begin = tissue->positions();
  int slept = 0, pressed = 0;
  for (int k = 0; k < 60; ++k) {
    const TissueStep& step = tissue->step({ballAt(kStep * k)}, kStep);
    EXPECT_FALSE(step.slept && !step.contacts.empty());
    if (step.contacts.empty()) continue;
    ++pressed;
    slept += step.sleeping_islands;
    EXPECT_EQ(step.far_bodies, 1);  // from the left one
  }
  EXPECT_GT(pressed, 10);
  EXPECT_EQ(slept, pressed);
  const Eigen::Index n = begin.cols() / 2;
  EXPECT_LT((tissue->positions() - begin).leftCols(n).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_GT((tissue->positions() - begin).rightCols(n).cwiseAbs().maxCoeff(), 1e-3);
  bool all = false;
  for (int k = 60; k < 600 && !all; ++k) all = tissue->step({}, kStep).slept;
  EXPECT_TRUE(all);
}

TEST(Islands, ResetAndRestoreRepeatEveryBit) {
  TwoSlabs slabs;
  const auto a = slabs.make(true), b = slabs.make(true);
  for (int k = 0; k < 50; ++k) a->step({ballAt(kStep * k)}, kStep);
  a->reset();
  EXPECT_EQ(a->positions(), b->positions());
  for (int k = 0; k < 50; ++k) {
    const Vec3 force = onTool(a->step({ballAt(kStep * k)}, kStep));
    ASSERT_EQ(force, onTool(b->step({ballAt(kStep * k)}, kStep)));
  }
  EXPECT_EQ(a->positions(), b->positions());
  const Points x = a->positions(), v = a->velocities();
  a->reset();
  a->setPositions(0, x, v);
  EXPECT_EQ(a->positions(), x);
  EXPECT_EQ(a->velocities(), v);
}

TEST(Islands, SayWhichPartIsNotHeld) {
  TwoSlabs slabs;
  slabs.free.rightCols(slabs.free.cols() / 2).setOnes();
  try {
    slabs.make(true);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(test::contains(error.what(), "part 2 of 2, from [0.1")) << error.what();
    EXPECT_TRUE(test::contains(error.what(), "translation along z")) << error.what();
  }
}

}  // namespace
}  // namespace palpate::tissue::islands_test

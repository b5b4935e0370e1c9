// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/enrichment/pressed_body.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "palpate/material/material.h"

namespace palpate::enrichment::pressed_body_test {
namespace {

constexpr double kYoung = 5e3, kSize = 0.04;

struct Bar {
  mesh::TetMesh mesh = mesh::boxMesh(Vec3(kSize, kSize, 2 * kSize), Eigen::Vector3i(4, 4, 8));
  fem::Composition composition = fem::Composition::uniform(
      material::makeMaterial("corotational",
                             {{"young_modulus", {kYoung}}, {"poisson_ratio", {0.0}}}),
      1000.0);
  fem::FreeMask free = fem::FreeMask::Ones(3, mesh.numPoints());

  explicit Bar(bool held = true) {
    for (Eigen::Index i = 0; held && i < mesh.numPoints(); ++i) {
      if (mesh.points(2, i) < 1e-9) free.col(i).setZero();
    }
  }
  PressedBody press(const Points& surface, double patch) const {
    return PressedBody("tet4", mesh, composition, free, surface, patch, nullptr);
  }
};

// A column whose top and sides are pulled down alike. Betti's theorem with uniform tension, which
// the elements have exactly: the mean displacement of the top is sum F z/(E A), where of ten
// squares of boundary one, the top, counts in full, eight half, the bottom not. Strains are of
// 1e-4.
TEST(PressedBody, ShortensAsAColumnUnderALargePatch) {
  Bar bar;
  std::vector<int> top;
  for (int i = 0; i < bar.mesh.numPoints(); ++i) {
    const Vec3 X = bar.mesh.points.col(i);
    bar.free.col(i) = (X.array() > 1e-9).cast<double>();  // symmetric: nothing turns
    if (X.z() > 2 * kSize - 1e-9) top.push_back(i);
  }
  Points surface(3, static_cast<Eigen::Index>(top.size()));
  for (std::size_t k = 0; k < top.size(); ++k) {
    surface.col(static_cast<Eigen::Index>(k)) = bar.mesh.points.col(top[k]);
  }
  PressedBody body = bar.press(surface, 1e6);  // all of the boundary alike
  Points u;
  const solver::StaticReport report =
      body.press({Vec3(0.02, 0.02, 0.04), Vec3(0, 0, -1e-3)}, {}, &u);
  ASSERT_EQ(report.status, solver::SolveStatus::kConverged);
  const double area = kSize * kSize;
  const Points shares =
      fem::tractionForces(bar.mesh.points, fem::selectFaces(mesh::boundaryFaces(bar.mesh), top),
                          Vec3(0, 0, 1.0 / area));
  double mean = 0.0;
  for (std::size_t k = 0; k < top.size(); ++k) {
    mean += shares(2, top[k]) * u(2, static_cast<Eigen::Index>(k));
  }
  const double part = (1.0 + 8.0 / 2.0) / 10.0;
  EXPECT_NEAR(mean / (-1e-3 * part * 2 * kSize / (kYoung * area)), 1.0, 1e-3);
}

TEST(PressedBody, GoesDownWhereItIsPressedAndForgetsIt) {
  const Bar bar;
  Points surface(3, 2);
  surface << 0.01, 0.03, 0.02, 0.02, 0.08, 0.08;
  PressedBody body = bar.press(surface, 0.01);
  Points left, right, again;
  const Vec3 down(0, 0, -0.2);
  body.press({surface.col(0), down}, {}, &left);
  body.press({surface.col(1), down}, {}, &right);
  body.press({surface.col(0), down}, {}, &again);
  EXPECT_LT(left(2, 0), 2.0 * left(2, 1));
  EXPECT_LT(right(2, 1), 2.0 * right(2, 0));
  EXPECT_LT(left(2, 0), -1e-3);
  EXPECT_EQ(left, again);
}

TEST(PressedBody, PressesTheNearestNodeWhereThePatchHasNone) {
  const Bar bar;
  Points surface(3, 1);
  surface << 0.01, 0.01, 0.08;
  PressedBody body = bar.press(surface, 1e-6);
  Points u;
  body.press({Vec3(0.0101, 0.0101, 0.081), Vec3(0, 0, -0.01)}, {}, &u);
  EXPECT_LT(u(2, 0), -1e-5);
}

TEST(PressedBody, RefusesABodyThatIsNotHeld) {
  const Bar bar(false);
  EXPECT_THROW(bar.press(Points::Zero(3, 1), 0.01), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::enrichment::pressed_body_test

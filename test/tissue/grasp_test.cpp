// SPDX-License-Identifier: GPL-3.0-or-later
// Two jaws take the end of a strip, by friction or with teeth, draw it and let it go.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "liver_slab.h"

namespace palpate::tissue::grasp_test {
namespace {

using test::onTool;

constexpr double kLength = 0.1, kWidth = 0.01, kThick = 0.006;  // [m]
constexpr double kYoung = 10e3;                                 // [Pa]
constexpr double kClose = 0.5e-3, kOpen = -2e-3;                // of each jaw into the strip [m]

// A strip whose one end is glued, and jaws on the last 20 mm of it.
struct Grasp {
  explicit Grasp(const contact::Friction& friction)
      : mesh(mesh::boxMesh(Vec3(kLength, kWidth, kThick), Eigen::Vector3i(20, 2, 2))) {
    fem::FreeMask free = fem::FreeMask::Ones(3, mesh.numPoints());
    for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
      if (mesh.points(0, i) == 0.0) free.col(i).setZero();
    }
    FemSettings settings;
    settings.sample_spacing = 0.001;  // so that the jaws' edges are met by samples alone
    settings.mass_damping = 4.0;      // it swings by itself in seconds
    settings.tolerance = 1e-6;
    settings.position_tolerance = 1e-8;
    settings.contact.friction_with.usual = friction;
    const auto law = material::makeMaterial(
        "neo_hookean", {{"young_modulus", {kYoung}}, {"poisson_ratio", {0.0}}});
    tissue = makeFemTissue(mesh, fem::Composition::uniform(law, 1000.0), free, settings);
  }

  // The jaws go on to that depth and that pull; the last step.
  const TissueStep& go(double to_depth, double to_pull, int steps) {
    const TissueStep* step = nullptr;
    const double depth_begin = depth, pull_begin = pull;
    for (int k = 1; k <= steps; ++k) {
      const double s = k / static_cast<double>(steps);
      const std::vector<Pose> before = jaws();
      depth = depth_begin + s * (to_depth - depth_begin);
      pull = pull_begin + s * (to_pull - pull_begin);
      const std::vector<Pose> after = jaws();
      step =
          &tissue->step({{&shape, 0, before[0], after[0]}, {&shape, 0, before[1], after[1]}}, 0.01);
      EXPECT_TRUE(solver::usable(step->status)) << solver::toString(step->status);
      highest = std::max(highest, -onTool(*step).x());
    }
    return *step;
  }
  std::vector<Pose> jaws() const {
    const double x = 0.09 + pull, y = 0.5 * kWidth;
    return {poseFromXyzRpy(Vec3(x, y, kThick + 0.004 - depth), Vec3::Zero()),
            poseFromXyzRpy(Vec3(x, y, -0.004 + depth), Vec3::Zero())};
  }
  // Between two cross-sections far from both ends.
  double stretch() const {
    double sum[2] = {0.0, 0.0};
    int number[2] = {0, 0};
    for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
      for (int k = 0; k < 2; ++k) {
        if (std::abs(mesh.points(0, i) - (k == 0 ? 0.02 : 0.06)) > 1e-6) continue;
        sum[k] += tissue->positions()(0, i);
        ++number[k];
      }
    }
    return (sum[1] / number[1] - sum[0] / number[0]) / 0.04;
  }
  // Of a bar of such a solid, whose sides are free: its width t times what it was is where the
  // energy is least.
  double closedForm() const {
    constexpr double kMu = kYoung / 2.0, kKappa = kYoung / 3.0;
    const double l = stretch();
    double low = 0.8, high = 1.1, along = 0.0;
    for (int k = 0; k < 60; ++k) {
      const double t = 0.5 * (low + high), J = l * t * t, I1 = l * l + 2.0 * t * t;
      const double isochoric = kMu * std::pow(J, -2.0 / 3.0), pressure = kKappa * (J - 1.0);
      const double across = isochoric * 2.0 * (t - I1 / (3.0 * t)) + 2.0 * pressure * l * t;
      along = isochoric * (l - I1 / (3.0 * l)) + pressure * t * t;
      (across > 0.0 ? high : low) = t;
    }
    return kWidth * kThick * along;
  }
  double farthestFromRest() const {
    return (tissue->positions() - mesh.points).cwiseAbs().maxCoeff();
  }

  mesh::TetMesh mesh;
  std::unique_ptr<TissueModel> tissue;
  instrument::Geometry shape = instrument::Box{Vec3(0.01, 0.02, 0.004)};
  double depth = kOpen, pull = 0.0, highest = 0.0;
};

class EveryGrasp : public ::testing::TestWithParam<contact::Friction> {};
INSTANTIATE_TEST_SUITE_P(ByFrictionAndTeeth, EveryGrasp,
                         ::testing::Values(contact::Friction{0.8, 0.6, 0.0},
                                           contact::Friction{0.0, 0.0, 1e4},
                                           contact::Friction{0.8, 0.6, 1e4}));

TEST_P(EveryGrasp, DrawsByWhatTheStretchAsksForAndLetsGo) {
  Grasp grasp(GetParam());
  for (const double pull : {0.004, 0.008}) {
    grasp.go(kClose, 0.0, 30);
    grasp.go(kClose, pull, 60);
    const TissueStep& step = grasp.go(kClose, pull, 100);
    EXPECT_NEAR(grasp.stretch(), 1.0 + pull / 0.08, 0.1 * pull / 0.08);
    const double force = -onTool(step).x();
    EXPECT_NEAR(force, grasp.closedForm(), 0.02 * grasp.closedForm()) << pull;
    EXPECT_NEAR(force, -step.support_force.x(), 0.02 * force) << pull;
    grasp.go(kOpen, pull, 30);
    for (int k = 0; k < 5; ++k) {
      const TissueStep& open = grasp.go(kOpen, pull, 1);
      EXPECT_LT(onTool(open).norm(), 1e-15);
    }
    grasp.go(kOpen, 0.0, 900);
    EXPECT_LT(grasp.farthestFromRest(), 1e-5);
  }
}

// Without friction or teeth it slips out.
TEST(Grasp, NeedsFrictionOrTeeth) {
  Grasp grasp({});
  grasp.go(kClose, 0.0, 30);
  grasp.go(kClose, 0.008, 60);
  EXPECT_LT(std::abs(onTool(grasp.go(kClose, 0.008, 100)).x()), 2e-3);
}

// Teeth let go where they must: not before the traction somewhere is what they sustain, nor after
// it would be everywhere.
TEST(Grasp, IsTornFromTeethAboveTheirForce) {
  constexpr double kTeeth = 300.0;  // [Pa]
  Grasp grasp({0.0, 0.0, kTeeth});
  grasp.go(kClose, 0.0, 30);
  grasp.go(kClose, 0.02, 400);
  const double of_both = kTeeth * 2.0 * 0.02 * kWidth;
  EXPECT_GT(grasp.highest, 0.05 * of_both);
  EXPECT_LT(grasp.highest, 1.1 * of_both);
  EXPECT_LT(std::abs(onTool(grasp.go(kClose, 0.02, 100)).x()), 2e-3);
  // What was torn off bites again only after the jaws were open.
  grasp.go(kClose, 0.022, 40);
  EXPECT_LT(std::abs(onTool(grasp.go(kClose, 0.022, 40)).x()), 2e-3);
  grasp.go(kOpen, 0.022, 30);
  grasp.go(kOpen, 0.0, 30);
  grasp.go(kClose, 0.0, 30);
  grasp.go(kClose, 0.002, 30);
  const TissueStep& again = grasp.go(kClose, 0.002, 60);
  EXPECT_NEAR(-onTool(again).x(), grasp.closedForm(), 0.02 * grasp.closedForm());
}

// One jaw alone holds nothing back that it draws away from.
TEST(Grasp, LiftsNothingWithOneJaw) {
  Grasp grasp({0.8, 0.6, 1e5});
  grasp.go(kClose, 0.0, 30);
  grasp.go(-0.5e-3, 0.0, 30);
  EXPECT_TRUE(grasp.go(-0.5e-3, 0.0, 5).contacts.empty());
}

}  // namespace
}  // namespace palpate::tissue::grasp_test

// SPDX-License-Identifier: GPL-3.0-or-later
// The augmented Lagrangian keeps tissue out of tools, whatever its parameter and however stiff the
// tissue is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "liver_slab.h"

namespace palpate::tissue::augmented_contact_test {
namespace {

using test::onTool;
constexpr double kStep = 0.01;
constexpr double kDensity = 10.0;  // so light that what is pressed is felt, not what is moved

double deepest(const TissueStep& step) {
  double penetration = 0.0;
  for (const TissueContact& c : step.contacts) penetration = std::max(penetration, c.penetration);
  return penetration;
}

// A block of 0.2 m under a plate of 256 cm^2 that goes down until it is pressed with 5 N, and
// rests.
struct Plate {
  instrument::Geometry shape = instrument::Box{Vec3(0.08, 0.08, 0.01)};
  double z = 0.0;

  contact::Obstacle to(double depth) {
    const auto at = [](double d) { return poseFromXyzRpy(Vec3(0.1, 0.1, 0.21 - d), Vec3::Zero()); };
    const contact::Obstacle way{&shape, 0, at(z), at(depth)};
    z = depth;
    return way;
  }
};

std::unique_ptr<TissueModel> block(double young_modulus, double stiffness) {
  mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.2, 0.2, 0.2), Eigen::Vector3i(5, 5, 5));
  fem::FreeMask free = fem::FreeMask::Ones(3, mesh.numPoints());
  for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
    if (mesh.points(2, i) == 0.0) free.col(i).setZero();
  }
  FemSettings settings;
  settings.contact.model = "augmented_lagrangian";
  settings.contact.stiffness = stiffness;
  settings.sample_spacing = 0.01;
  settings.mass_damping = 20.0;
  settings.position_tolerance = 0.0;  // some of these blocks give way by less than 0.1 mm
  const auto law = material::makeMaterial(
      "neo_hookean", {{"young_modulus", {young_modulus}}, {"poisson_ratio", {0.45}}});
  return makeFemTissue(mesh, fem::Composition::uniform(law, kDensity), free, settings);
}

class OfStiffness : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Tissues, OfStiffness, ::testing::Values(0.5e3, 5e3, 50e3, 500e3),
                         [](const auto& value) {
                           return std::to_string(static_cast<int>(value.param)) + "_Pa";
                         });

TEST_P(OfStiffness, IsNotEnteredUnderFiveNewtonsWhateverTheParameter) {
  const double young_modulus = GetParam();
  const double step_down = 5.0 * 0.2 / (young_modulus * 0.0256) / 100.0;
  double depth = 0.0, reference = 0.0;
  for (const double stiffness : {3e8, 1e8, 1e9, 1e10, 1e11}) {
    const auto tissue = block(young_modulus, stiffness);
    Plate plate;
    const TissueStep* step = nullptr;
    const bool first = depth == 0.0;
    for (int k = 1; k <= 200; ++k) {
      const double next = k * step_down;
      step = &tissue->step({plate.to(first ? next : std::min(next, depth))}, kStep);
      ASSERT_TRUE(solver::usable(step->status)) << stiffness << " " << k;
      if (first && onTool(*step).z() >= 5.0) {
        depth = next;
        break;
      }
    }
    ASSERT_GT(depth, 0.0);
    for (int k = 0; k < 100; ++k) step = &tissue->step({plate.to(depth)}, kStep);
    EXPECT_EQ(step->status, solver::SolveStatus::kConverged) << stiffness;
    EXPECT_LE(deepest(*step), 5e-5) << stiffness;
    const double force = onTool(*step).z();
    EXPECT_GT(force, 4.0);
    if (first) reference = force;
    // Into the softest tissue the plate goes so deep that its edge, which meets the faces by balls
    // without a multiplier, bears a part that depends on how it got there.
    const bool by_edge = young_modulus < 1e3;
    EXPECT_NEAR(force, reference, (by_edge ? 0.03 : 0.005) * reference) << stiffness;
    RecordProperty("force at " + std::to_string(stiffness), std::to_string(force));
  }
}

// Pressed against what cannot give way, only the penalty is left: the force does not grow for ever.
TEST(AugmentedContact, DoesNotGrowWhereTheTissueIsHeld) {
  const auto tissue = block(5e3, 3e8);
  instrument::Geometry ball = instrument::Sphere{0.01};
  const Pose at = poseFromXyzRpy(Vec3(0.1, 0.1, -0.0095), Vec3::Zero());  // 0.5 mm into the bottom
  double before = 0.0;
  for (int k = 0; k < 50; ++k) {
    const double force = onTool(tissue->step({{&ball, 0, at, at}}, kStep)).norm();
    if (k > 10) {
      EXPECT_NEAR(force, before, 1e-6 * force);
    }
    before = force;
  }
}

// What it remembers does not press where the tool has left.
TEST(AugmentedContact, EndsWithTheTouch) {
  const auto tissue = block(5e3, 3e8);
  const Points rest = tissue->positions();
  Plate plate;
  for (int k = 1; k <= 20; ++k) tissue->step({plate.to(k * 1e-3)}, kStep);
  EXPECT_GT(onTool(tissue->step({plate.to(0.02)}, kStep)).z(), 1.0);
  EXPECT_TRUE(tissue->step({plate.to(-0.05)}, kStep).contacts.empty());
  for (int k = 0; k < 200; ++k) tissue->step({plate.to(-0.05)}, kStep);
  EXPECT_LT((tissue->positions() - rest).cwiseAbs().maxCoeff(), 1e-5);
}

// An integral that follows what swings would drive it; short steps of a second-order method damp it
// least. Without multipliers the greatest force is 1.04 N.
TEST(AugmentedContact, DoesNotSwingUpInShortSteps) {
  for (const double step : {5e-4, 2e-3}) {
    test::LiverSlab slab("implicit_pcg");
    slab.settings.integrator = "bdf2";
    slab.settings.mass_damping = 5.0;
    const auto tissue = slab.make();
    double greatest = 0.0;
    for (test::LiverPress press(0.006, 0.05, step); press.time() < 0.4;) {
      greatest = std::max(greatest, onTool(tissue->step({press.next()}, step)).z());
    }
    EXPECT_GT(greatest, 0.9) << step;
    EXPECT_LT(greatest, 1.1) << step;
  }
}

}  // namespace
}  // namespace palpate::tissue::augmented_contact_test

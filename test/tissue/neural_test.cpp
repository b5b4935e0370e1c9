// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "model_variants.h"
#include "support/contains.h"
#include "tissue/models/neural/tool_press.h"

namespace palpate::tissue::neural_test {
namespace {

using test::contains;
using test::kStep;
using test::onTool;

contact::Obstacle at(const instrument::Geometry& shape, const Vec3& p, int owner = 0) {
  const Pose pose(Eigen::Translation3d{p});
  return {&shape, owner, pose, pose};
}

const mesh::TetMesh& block() {
  static const mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.06, 0.06, 0.03), Eigen::Vector3i(6, 6, 3));
  return mesh;
}

PressFinder blockFinder() {
  return {block().points, mesh::trianglesOf(mesh::boundaryFaces(block()))};
}

TEST(PressFinder, FindsTheDeepestPlaceOfABall) {
  const PressFinder finder = blockFinder();
  const instrument::Geometry ball = instrument::Sphere{0.008};
  for (const Vec3& p : {Vec3(0.0312, 0.0287, 0.036), Vec3(0.011, 0.052, 0.034)}) {
    const ToolPress press = finder.find(at(ball, p));
    EXPECT_NEAR(press.depth, 0.038 - p.z(), 1e-12);
    EXPECT_LT((press.normal_W - Vec3(0, 0, -1)).norm(), 1e-12);
    EXPECT_LT((press.p_W - Vec3(p.x(), p.y(), p.z() - 0.008)).norm(), 1e-12);
    EXPECT_NEAR(press.radius, 0.008, 1e-12);
  }
  EXPECT_EQ(finder.find(at(ball, Vec3(0.03, 0.03, 0.0381))).depth, 0.0);
  EXPECT_EQ(finder.find(at(ball, Vec3(0.3, 0.03, 0.03))).depth, 0.0);
}

// Of a capsule that stands askew over the top its lower end; nothing that is flat, or round in one
// direction alone, has a radius.
TEST(PressFinder, FindsTheEndOfACapsuleAndKnowsWhatIsNoBall) {
  const PressFinder finder = blockFinder();
  const instrument::Geometry capsule = instrument::Capsule{0.005, 0.01};
  const Pose askew = poseFromXyzRpy(Vec3(0.03, 0.03, 0.04), Vec3(0.4, 0.0, 0.0));
  const Vec3 end = askew * Vec3(0, 0, -0.01);
  const ToolPress press = finder.find({&capsule, 0, askew, askew});
  EXPECT_NEAR(press.depth, 0.03 - (end.z() - 0.005), 1e-9);
  EXPECT_LT((press.p_W - (end - Vec3(0, 0, 0.005))).norm(), 1e-6);
  EXPECT_NEAR(press.radius, 0.005, 1e-9);
  const Pose lying = poseFromXyzRpy(Vec3(0.03, 0.03, 0.034), Vec3(0.5 * std::acos(-1.0), 0, 0));
  EXPECT_EQ(finder.find({&capsule, 0, lying, lying}).radius, 0.0);
  EXPECT_NEAR(finder.find({&capsule, 0, lying, lying}).depth, 0.001, 1e-9);
  const instrument::Geometry box = instrument::Box{Vec3(0.01, 0.01, 0.01)};
  EXPECT_EQ(finder.find(at(box, Vec3(0.03, 0.03, 0.038))).radius, 0.0);
  EXPECT_NEAR(finder.find(at(box, Vec3(0.03, 0.03, 0.038))).depth, 0.002, 1e-9);
}

class Neural : public ::testing::Test {
 protected:
  std::unique_ptr<TissueModel> make(const std::string& model = "neural") const {
    return test::makeOrgans({organ}, settings, nullptr, model);
  }
  Neural() {
    organ = test::variantBlock(test::neuralVariant(true));
    settings.gravity.setZero();
  }
  test::OrganSketch organ;
  ModelSettings settings = test::variantSettings();
  const instrument::Geometry ball = instrument::Sphere{0.008};
};

// A press as it learned: its force is the surrogate's times the ratio of Hertz and the patch, along
// the tool's normal, and no element is solved.
TEST_F(Neural, TellsWhatWasLearnedAndSolvesNothing) {
  const auto tissue = make();
  enrichment::Surrogate surrogate = enrichment::readSurrogate(organ.neural.file);
  Eigen::VectorXd work;
  for (const double depth : {1e-6, 5e-4, 1e-3, 2e-3, 3e-3}) {
    const TissueStep& step = tissue->step({at(ball, Vec3(0.03, 0.03, 0.038 - depth))}, kStep);
    ASSERT_TRUE(step.ok());
    EXPECT_EQ(step.newton_iterations, 0) << depth;
    ASSERT_EQ(step.contacts.size(), 1U);
    Vec3 force;
    surrogate.predict(Vec3(0.03, 0.03, 0.03), Vec3(0, 0, -depth), &work, &force, nullptr);
    const double ratio =
        32.0 * std::sqrt(0.008 * depth) / (9.0 * std::acos(-1.0) * test::LearnedBox::kPatch);
    EXPECT_NEAR(onTool(step).z(), -ratio * force.z(), 1e-9 * std::abs(force.z()));
    EXPECT_LT(onTool(step).head<2>().norm(), 1e-12);
  }
}

// Out of what was learned, deeper and aside, and back. In a cycle the force changes by no more than
// twice what that of elements alone does on this way, and what the switch may carry over: its part
// of a cycle times the sum of both forces.
TEST_F(Neural, GoesToTheElementsAndBackWithoutAJump) {
  const auto neural = make(), elements = make("fem");
  const auto run = [&](TissueModel* tissue, double* most, double* step_most, int* solved) {
    Vec3 last = Vec3::Zero();
    Vec3 before(0.03, 0.03, 0.04);
    for (int k = 0; k < 400; ++k) {
      const double t = kStep * k;
      const double down = std::min(0.02 * t, 0.005) - std::max(0.0, 0.02 * (t - 3.5));
      const double aside = 0.022 * std::max(0.0, std::sin((t - 0.5) / 2.5 * std::acos(-1.0))) *
                           (t > 0.5 && t < 3.0 ? 1.0 : 0.0);
      const Vec3 p(0.03 + aside, 0.03, 0.0385 - down);
      const contact::Obstacle way{&ball, 0, Pose(Eigen::Translation3d(before)),
                                  Pose(Eigen::Translation3d(p))};
      before = p;
      const TissueStep& step = tissue->step({way}, kStep);
      ASSERT_TRUE(step.ok()) << t;
      *most = std::max(*most, onTool(step).norm());
      *step_most = std::max(*step_most, (onTool(step) - last).norm());
      *solved += step.newton_iterations > 0;
      last = onTool(step);
    }
  };
  double told = 0.0, told_step = 0.0, alone = 0.0, alone_step = 0.0;
  int solved = 0, all = 0;
  run(neural.get(), &told, &told_step, &solved);
  run(elements.get(), &alone, &alone_step, &all);
  std::printf("a cycle changes %.4f N of %.3f; of elements alone %.4f N of %.3f; solved %d, %d\n",
              told_step, told, alone_step, alone, solved, all);
  EXPECT_LT(told_step, 2.0 * alone_step + kStep / organ.neural.switch_time * (told + alone));
  EXPECT_GT(solved, 20);        // it did leave
  EXPECT_LT(solved, all - 20);  // and came back
}

// A tool that was never like those learned is of elements from its first touch on: what it was
// taken for at first would be told while they come.
TEST_F(Neural, IsOfElementsFromTheFirstTouchOfAStrangeTool) {
  const instrument::Geometry flat = instrument::Box{Vec3(0.008, 0.008, 0.01)};
  const auto neural = make(), elements = make("fem");
  double most = 0.0, off = 0.0;
  for (int k = 0; k < 40; ++k) {
    const auto pose = [](double t) {
      return Pose(Eigen::Translation3d(0.03, 0.03, 0.041 - std::min(0.02 * t, 0.004)));
    };
    const contact::Obstacle way{&flat, 0, pose(kStep * k), pose(kStep * (k + 1))};
    const Vec3 told = onTool(neural->step({way}, kStep));
    const Vec3 right = onTool(elements->step({way}, kStep));
    off = std::max(off, (told - right).norm());
    most = std::max(most, right.norm());
  }
  EXPECT_GT(most, 0.05);
  EXPECT_LT(off, 0.01 * most);
}

// In the cycle in which it leaves them, too, when they were solved once more.
TEST_F(Neural, TellsNoResidualOfElementsThatItHasLeft) {
  const instrument::Geometry flat = instrument::Box{Vec3(0.008, 0.008, 0.01)};
  const auto tissue = make();
  int solved = 0, slept = 0;
  for (int k = 0; k < 400 && slept < 3; ++k) {
    const auto pose = [](int of) {
      return Pose(
          Eigen::Translation3d(0.03, 0.03, 0.041 - 0.004 * std::sin(0.1 * std::min(of, 31))));
    };
    const TissueStep& step = tissue->step({{&flat, 0, pose(k), pose(k + 1)}}, kStep);
    ASSERT_TRUE(step.ok()) << k;
    solved += step.newton_iterations > 0;
    if (!step.slept || solved == 0) continue;
    EXPECT_EQ(step.residual, 0.0) << k;
    ++slept;
  }
  EXPECT_GT(solved, 5);
  EXPECT_EQ(slept, 3);
}

// Of two tools nothing was learned: in the end they feel what they do of elements alone.
TEST_F(Neural, IsOfElementsUnderTwoTools) {
  const auto neural = make(), elements = make("fem");
  for (int k = 0; k < 100; ++k) {
    const std::vector<contact::Obstacle> tools{at(ball, Vec3(0.022, 0.03, 0.036)),
                                               at(ball, Vec3(0.042, 0.03, 0.036), 1)};
    const Vec3 told = onTool(neural->step(tools, kStep));
    const TissueStep& step = elements->step(tools, kStep);
    ASSERT_TRUE(step.ok());
    if (k == 99) {
      EXPECT_LT((told - onTool(step)).norm(), 1e-3 * onTool(step).norm());
      EXPECT_LT((neural->positions() - elements->positions()).cwiseAbs().maxCoeff(), 1e-6);
    }
  }
}

TEST_F(Neural, RefusesWhatItHasNotLearned) {
  const auto refusal = [&] {
    try {
      make();
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal(), "");
  const test::OrganSketch good = organ;
  organ.neural.file.clear();
  EXPECT_TRUE(contains(refusal(), "palpate train")) << refusal();
  organ = good;
  organ.adapt.finest = 0.002;
  EXPECT_TRUE(contains(refusal(), "adapt")) << refusal();
  organ = good;
  organ.solid.prony = {{0.5, 1.0}};
  EXPECT_TRUE(contains(refusal(), "viscous")) << refusal();
  organ = good;
  settings.needles = true;
  EXPECT_TRUE(contains(refusal(), "needle")) << refusal();
  settings.needles = false;
  organ = test::block("larger", Vec3::Zero(), Vec3(0.08, 0.06, 0.03), Eigen::Vector3i(4, 4, 2),
                      good.held);
  organ.neural = good.neural;
  EXPECT_TRUE(contains(refusal(), "another body")) << refusal();
}

}  // namespace
}  // namespace palpate::tissue::neural_test

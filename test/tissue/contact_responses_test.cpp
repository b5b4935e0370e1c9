// SPDX-License-Identifier: GPL-3.0-or-later
// A response that is not of the table, bilateral and with a memory, in every method that takes
// responses.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "liver_slab.h"
#include "palpate/solver/minimizer_list.h"
#include "support/hold_response.h"

namespace palpate::tissue::contact_responses_test {
namespace {

using test::LiverSlab;
constexpr double kStep = 0.01;

std::vector<std::string> methods() {
  std::vector<std::string> names = solver::minimizerNames();
  names.insert(names.end(), {"tled", "linear_precomputed"});
  return names;
}

// A ball that goes 3 mm into the slab, aside by 1 mm and up again, to 4 mm above its top.
struct Ball {
  instrument::Geometry shape = instrument::Sphere{0.01};
  static constexpr int kSteps = 60;
  static Pose at(int k) {
    const double down = std::min(k, 20) * 0.15e-3, aside = std::clamp(k - 20, 0, 10) * 0.1e-3;
    const double up = std::clamp(k - 30, 0, 30) * 0.2333e-3;
    return poseFromXyzRpy(Vec3(0.05 + aside, 0.05, 0.05 - down + up), Vec3(0.0, 0.0, 0.01 * k));
  }
  contact::Obstacle step(int k) const { return {&shape, 0, at(k), at(k + 1)}; }
};

LiverSlab slabWith(const std::string& method, const std::string& response) {
  LiverSlab slab(method, Eigen::Vector3i(6, 6, 3));
  slab.settings.responses.push_back(test::kHold);
  slab.settings.contact.model = response;
  slab.settings.contact.stiffness = 1e7;
  slab.settings.mass_damping = 20.0;
  return slab;
}

class EveryMethodThatTakesResponses : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Methods, EveryMethodThatTakesResponses, ::testing::ValuesIn(methods()),
                         [](const auto& name) { return name.param; });

TEST_P(EveryMethodThatTakesResponses, HoldsTheTissueAndBalancesForces) {
  for (const std::string response : {"penalty", "augmented_lagrangian", "hold"}) {
    const auto tissue = slabWith(GetParam(), response).make();
    const Points rest = tissue->positions();
    const Ball ball;
    Vec3 force = Vec3::Zero();
    double least = 0.0;
    for (int k = 0; k < Ball::kSteps; ++k) {
      const TissueStep& step = tissue->step({ball.step(k)}, kStep);
      ASSERT_TRUE(solver::usable(step.status)) << k << " " << solver::toString(step.status);
      force.setZero();
      for (const TissueContact& c : step.contacts) {
        force += c.force_W;
        least = std::min(least, c.penetration);
      }
      const Vec3 sum = step.support_force + step.gravity_force + step.inertia_force - force;
      EXPECT_LE(sum.norm(), 0.01 * force.norm() + 2e-3) << response << " " << k;
      if (k == 20) {
        EXPECT_GT(force.z(), 0.05);  // pressed, it pushes back
      }
    }
    const double rise = (tissue->positions() - rest).row(2).maxCoeff();  // [m]
    if (response == "hold") {
      EXPECT_LT(force.z(), -0.05);  // lifted, it pulls
      EXPECT_GT(rise, 1e-3);
      EXPECT_LT(least, -1e-5);
    } else {
      EXPECT_LT(force.norm(), 1e-3);
      EXPECT_LT(rise, 1e-3);
    }
  }
}

TEST_P(EveryMethodThatTakesResponses, SameBitsWithThreadsAndAfterAReset) {
  ThreadPool pool(2);
  const LiverSlab slab = slabWith(GetParam(), "hold");
  const auto one = slab.make(), two = slab.make(&pool);
  const Ball ball;
  const auto run = [&](TissueModel* tissue) {
    for (int k = 0; k < Ball::kSteps; ++k) tissue->step({ball.step(k)}, kStep);
    return tissue->positions();
  };
  const Points first = run(one.get());
  EXPECT_EQ(run(two.get()), first);
  one->reset();  // and the memory with it
  EXPECT_EQ(run(one.get()), first);
}

// Has no answer to a motion of more than 0.1 mm in a step, and counts the steps that have ended.
class Cautious final : public contact::Response {
 public:
  static int ended;  // of the last one that was asked

  bool followsMotion() const override { return true; }
  double energy(const contact::Touch& touch) const override {
    if (touch.motion_W.norm() > 1e-4) return std::numeric_limits<double>::quiet_NaN();
    return 0.5 * 1e7 * touch.area * touch.gap * std::min(touch.gap, 0.0);
  }
  contact::TouchForce force(const contact::Touch& touch) const override {
    return {1e7 * touch.area * std::min(touch.gap, 0.0), Vec3::Zero()};
  }
  Mat3 stiffness(const contact::Touch& touch, fem::Tangent) const override {
    return 1e7 * touch.area * touch.normal_W * touch.normal_W.transpose();
  }
  bool remembers() const override { return true; }
  void endStep(const std::vector<contact::Touch>&) override { ended = ++steps_; }
  void save(StateWriter* to) const override { to->put(steps_); }
  void restore(StateReader* from) override { from->get(&steps_); }

 private:
  int steps_ = 0;
};
int Cautious::ended = 0;

class EveryMinimizerWithResponses : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Methods, EveryMinimizerWithResponses,
                         ::testing::ValuesIn(solver::minimizerNames()),
                         [](const auto& name) { return name.param; });

// A cycle that is tried again, in more and shorter steps, begins with the memory that it had.
TEST_P(EveryMinimizerWithResponses, ForgetsWhatAFailedCycleDid) {
  LiverSlab slab = slabWith(GetParam(), "cautious");
  slab.settings.responses.push_back(
      {"cautious", [](const contact::ResponseSettings&) -> std::unique_ptr<contact::Response> {
         return std::make_unique<Cautious>();
       }});
  const auto tissue = slab.make();
  const Ball ball;
  Cautious::ended = 0;
  int more = 0;
  for (int k = 0; k < 15; ++k) {
    const int before = Cautious::ended;
    const TissueStep& step = tissue->step({ball.step(k)}, kStep);
    ASSERT_TRUE(solver::usable(step.status)) << k << " " << solver::toString(step.status);
    EXPECT_EQ(Cautious::ended - before, step.time_steps);
    more += step.time_steps > 1 ? 1 : 0;
  }
  EXPECT_GT(more, 3);
}

TEST(ContactResponses, OfUnknownNamesAreRefused) {
  EXPECT_THROW(slabWith("implicit_pcg", "glue").make(), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::tissue::contact_responses_test

// SPDX-License-Identifier: GPL-3.0-or-later
// What is turned inside out or crushed is put back also where it touches another organ.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "two_organs.h"

namespace palpate::tissue::group_recovery_test {
namespace {

using test::block;
using test::makeOrgans;
using test::OrganSketch;

constexpr double kGap = 2e-4;  // of two organs [m]
const auto kHeldBelow = [](double z) { return [z](const Vec3& X) { return X.z() <= z; }; };

ModelSettings settings() {
  ModelSettings settings = test::organSettings();
  settings.gravity.setZero();
  return settings;
}

material::Solid solidOf(const std::string& law, double poisson_ratio) {
  return {
      material::makeMaterial(law, {{"young_modulus", {6.0e3}}, {"poisson_ratio", {poisson_ratio}}}),
      1060.0,
      {}};
}

// Next to the incompressible: turned inside out it trembles by micrometres for ever.
OrganSketch trembling() {
  OrganSketch organ = block("slab", Vec3::Zero(), Vec3(0.1, 0.1, 0.04), {4, 4, 3}, kHeldBelow(0.0));
  organ.element = "p1p1";
  organ.solid = solidOf("stable_neo_hookean", 0.4999);
  organ.damping = {60.0, 0.0};
  return organ;
}

// Of a law that has other states of rest, folded.
OrganSketch foldable() {
  OrganSketch organ = block("slab", Vec3::Zero(), Vec3(0.1, 0.1, 0.04), {5, 5, 3}, kHeldBelow(0.0));
  organ.solid = solidOf("st_venant_kirchhoff", 0.3);
  organ.damping = {60.0, 0.0};
  return organ;
}

// Beside the slab.
OrganSketch neighbour() {
  OrganSketch organ =
      block("wall", Vec3(0.1 + kGap, 0.0, 0.0), Vec3(0.02, 0.1, 0.04), {1, 4, 2}, kHeldBelow(0.0));
  organ.damping = {60.0, 0.0};
  return organ;
}

// Pulls what is highest of the slab to a part of its height above what is lowest of the wall, in z.
class LidTerm final : public InteractionTerm {
 public:
  LidTerm(const Points& slab, const Points& wall, double part) {
    for (int i = 0; i < slab.cols(); ++i) {
      if (slab(2, i) >= slab.row(2).maxCoeff()) top_.push_back(i);
    }
    Eigen::Index low = 0;
    wall.row(2).minCoeff(&low);
    low_ = static_cast<int>(slab.cols() + low);
    gap_ = part * (slab.row(2).maxCoeff() - slab.row(2).minCoeff());
  }
  void search(const Points&, double) override {}
  bool holds(const Points&) const override { return true; }
  double value(const Points& x) const override {
    double sum = 0.0;
    for (const int i : top_) sum += 0.5 * kStiffness * pow2(off(x, i));
    return sum;
  }
  double addGradient(const Points& x, Points* g) const override {
    for (const int i : top_) {
      (*g)(2, i) += kStiffness * off(x, i);
      (*g)(2, low_) -= kStiffness * off(x, i);
    }
    return value(x);
  }
  void addHessian(const Points&, fem::Tangent, fem::Stiffness* K) const override {
    const Mat3 H = Vec3(0.0, 0.0, kStiffness).asDiagonal();
    for (const int i : top_) {
      K->add(i, i, H);
      K->add(low_, low_, H);
      K->add(i, low_, -H);
      K->add(low_, i, -H);
    }
  }

 private:
  static constexpr double kStiffness = 1e3;  // [N/m]
  static double pow2(double s) { return s * s; }
  double off(const Points& x, int i) const { return x(2, i) - x(2, low_) - gap_; }

  std::vector<int> top_;
  int low_ = 0;
  double gap_ = 0.0;
};

class Lid final : public Interaction {
 public:
  explicit Lid(double part) : part_(part) {}
  bool possible(const InteractingBody& a, const InteractingBody& b) const override {
    return &a != &b;
  }
  std::unique_ptr<InteractionTerm> make(const InteractingBody& a,
                                        const InteractingBody& b) const override {
    return std::make_unique<LidTerm>(a.X, b.X, part_);
  }

 private:
  double part_;
};

template <int percent>
InteractionEntry lid() {
  return {"lid", [](const ModelSettings&) {
            return std::shared_ptr<const Interaction>(new Lid(0.01 * percent));
          }};
}

// Through its middle, but for what is held.
Points pointReflected(const OrganSketch& organ) {
  const Points& X = organ.mesh.points;
  const Vec3 middle = X.rowwise().mean();
  const Points inverted = (-X).colwise() + 2.0 * middle;
  return X + (inverted - X).cwiseProduct(organ.free);
}

// Through the plane that holds it.
Points mirrored(const OrganSketch& organ) {
  Points x = organ.mesh.points;
  x.row(2) *= -1.0;
  return x;
}

// Cycles until all sleep; 0: they do not.
int cyclesToRest(TissueModel* tissue, double dt, int* worst = nullptr, int* together = nullptr) {
  for (int k = 1; k <= 600; ++k) {
    const TissueStep& step = tissue->step({}, dt);
    EXPECT_FALSE(step.ok() && step.min_jacobian <= 0.0) << k;
    if (worst) *worst = std::max(*worst, step.recovery);
    if (together) *together += (*tissue->reports())[0].apart_organs == 0;
    if (step.slept) return k;
  }
  return 0;
}

// The slab starts at x, next to another slab. Both must end at rest at their equilibrium, and no
// cycle with an inverted slab is reported as converged.
void expectPutBack(const OrganSketch& slab, const Points& x, double dt) {
  const std::vector<OrganSketch> organs = {slab, neighbour()};
  const auto tissue = makeOrgans(organs, settings()), alike = makeOrgans(organs, settings());
  tissue->setPositions(0, x, Points::Zero(3, x.cols()));
  int worst = 0, together = 0;
  EXPECT_GT(cyclesToRest(tissue.get(), dt, &worst, &together), 0);
  EXPECT_EQ(worst, static_cast<int>(Recovery::kPutBack));
  EXPECT_GT(together, 10);
  EXPECT_GT(cyclesToRest(alike.get(), dt), 0);
  for (int o = 0; o < tissue->numOrgans(); ++o) {
    const Points off = tissue->positions(o) - alike->positions(o);
    EXPECT_LT(off.cwiseAbs().maxCoeff(), 1e-4 * 0.1) << organs[static_cast<std::size_t>(o)].name;
  }
}

TEST(GroupRecovery, PutsBackWhatTremblesTurnedInsideOut) {
  const OrganSketch slab = trembling();
  expectPutBack(slab, pointReflected(slab), 0.005);
}

TEST(GroupRecovery, PutsBackWhatRestsCrushed) {
  const OrganSketch slab = foldable();
  expectPutBack(slab, mirrored(slab), 0.01);
}

// Two that are far away, and remember where they met, take no notice of that.
TEST(GroupRecovery, LeavesOthersAsTheyAre) {
  const OrganSketch slab = foldable();
  std::vector<OrganSketch> pair = test::twoBlocks(0.003);
  for (OrganSketch& organ : pair) organ.mesh.points.row(1).array() += 1.0;
  ModelSettings remember = settings();
  remember.interactions = {test::repulsion<50>()};
  const auto all = makeOrgans({slab, neighbour(), pair[0], pair[1]}, remember);
  const auto alone = makeOrgans(pair, remember);
  const Points x = mirrored(slab);
  all->setPositions(0, x, Points::Zero(3, x.cols()));
  bool put_back = false;
  for (int k = 0; k < 600 && !(put_back && k % 50 == 0); ++k) {
    put_back |= all->step({}, 0.01).recovery == static_cast<int>(Recovery::kPutBack);
    alone->step({}, 0.01);
    for (int o = 0; o < 2; ++o) ASSERT_EQ(all->positions(2 + o), alone->positions(o)) << k;
  }
  EXPECT_TRUE(put_back);
}

// What became of a slab that its neighbour presses.
struct Pressed {
  int put_back = 0, asleep = 0;  // cycles
  double least = 1.0;            // det F
};
Pressed press(const OrganSketch& slab, const InteractionEntry& lid, int cycles) {
  ModelSettings pressed = settings();
  pressed.interactions = {lid};
  const auto tissue = makeOrgans({slab, neighbour()}, pressed);
  Pressed out;
  for (int k = 0; k < cycles && out.asleep < 100; ++k) {
    const TissueStep& step = tissue->step({}, 0.01);
    out.put_back += step.recovery == static_cast<int>(Recovery::kPutBack);
    out.asleep += step.slept;
    out.least = std::min(out.least, step.min_jacobian);
  }
  return out;
}

// Flat: put back, it is pressed so again, and rests so.
TEST(GroupRecovery, PutsBackOnceWhatIsPressed) {
  OrganSketch slab = foldable();
  slab.solid = solidOf("stable_neo_hookean", 0.0);
  const Pressed done = press(slab, lid<5>(), 600);
  EXPECT_LT(done.least, 0.1);  // else it is not as flat as what is taken for crushed
  EXPECT_EQ(done.put_back, 1);
  EXPECT_EQ(done.asleep, 100);
}

// Likewise inside out.
TEST(GroupRecovery, PutsBackOnceWhatIsPressedInsideOut) {
  OrganSketch slab = foldable();
  slab.solid = solidOf("stable_neo_hookean", 0.3);
  const Pressed done = press(slab, lid<-200>(), 600);
  EXPECT_LT(done.least, 0.0);
  EXPECT_EQ(done.put_back, 1);
  EXPECT_EQ(done.asleep, 100);
}

}  // namespace
}  // namespace palpate::tissue::group_recovery_test

// SPDX-License-Identifier: GPL-3.0-or-later
// What is turned inside out or crushed is put back also where it touches another organ.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "two_organs.h"

namespace palpate::tissue {
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

// The slab is placed at x, beside another: both end at rest where they would be without that, and
// no cycle in which one is inside out is called converged.
void expectPutBack(const OrganSketch& slab, const Points& x, double dt) {
  const std::vector<OrganSketch> organs = {slab, neighbour()};
  const auto tissue = makeOrgans(organs, settings()), alike = makeOrgans(organs, settings());
  tissue->place(0, x, Points::Zero(3, x.cols()));
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

}  // namespace
}  // namespace palpate::tissue

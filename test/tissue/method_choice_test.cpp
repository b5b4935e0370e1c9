// SPDX-License-Identifier: GPL-3.0-or-later
#include "tissue/methods/method_choice.h"

#include <gtest/gtest.h>

#include "liver_slab.h"
#include "palpate/tissue/fem/islands.h"
#include "support/contains.h"

namespace palpate::tissue::method_choice_test {
namespace {

using test::LiverPress;
using test::LiverSlab;

using test::contains;

// 20,000 tetrahedra at nu = 0.45.
CycleCounts usualCounts() {
  CycleCounts c;
  c.poisson_ratio = 0.45;
  c.tets = {20e3, false, true};
  c.blocks = 55e3;
  c.volume_entries = 55e3;
  c.linear_iterations = 15;
  c.direct = 0.12;
  c.factor_flops = 2.35e9;
  c.factor_nonzeros = 4.5e6;
  c.sub_steps = 40.0;
  c.explicit_accepts = c.mass_damping = true;
  return c;
}

TEST(MethodChoice, IsConjugateGradientsAsARule) {
  const MethodChoice choice = chooseMethod(usualCounts());
  EXPECT_EQ(choice.method, "implicit_pcg");
  // 2 (52 ns 20e3 + 3.6 ns 55e3) + 2 x 15 (1.3 + 1.3 ns) 55e3 = 2.5 ms + 4.3 ms
  EXPECT_TRUE(contains(choice.reason, "takes implicit_pcg")) << choice.reason;
  EXPECT_TRUE(contains(choice.reason, "implicit_pcg 6.8 ms")) << choice.reason;
  EXPECT_TRUE(contains(choice.reason, "15 iterations")) << choice.reason;
}

TEST(MethodChoice, IsLbfgsWhereConjugateGradientsCrawl) {
  CycleCounts c = usualCounts();
  c.linear_iterations = 200;
  c.poisson_ratio = 0.499;
  EXPECT_EQ(chooseMethod(c).method, "lbfgs");
}

TEST(MethodChoice, StaysWithTheUsualMethodForASmallGain) {
  CycleCounts c = usualCounts();
  c.tets.averaged = c.mass_damping = false;
  c.volume_entries = 0.0;
  int least = 1;
  for (; least < 1000; ++least) {
    c.linear_iterations = least;
    if (chooseMethod(c).method != "implicit_pcg") break;
  }
  EXPECT_EQ(chooseMethod(c).method, "lbfgs");
  // lbfgs: 8 (0.19 + 3.27 ms) + (0.72 + 117.5 ms)/30 = 31.6 ms, to be below 0.8 of
  // 2 (0.92 ms + n 0.0715 ms): n > 263.
  EXPECT_EQ(least, 264);
}

TEST(MethodChoice, IsDirectWhereAFactorCostsLittle) {
  CycleCounts c = usualCounts();
  c.tets.number = 1000.0;
  c.blocks = 3000.0;
  c.volume_entries = 3000.0;
  c.linear_iterations = 60;
  c.direct = 0.07e-3;
  c.factor_flops = 1e6;
  c.factor_nonzeros = 30e3;
  EXPECT_EQ(chooseMethod(c).method, "implicit_direct");
}

TEST(MethodChoice, IsExplicitOnlyWhereThatIsClearlyCheaper) {
  CycleCounts c = usualCounts();
  c.sub_steps = 13.0;  // of 0.30 ms: 3.9 ms of 6.8 ms
  EXPECT_EQ(chooseMethod(c).method, "tled");
  c.sub_steps = 14.0;
  EXPECT_EQ(chooseMethod(c).method, "implicit_pcg");
  c.tets = {2500.0, true, true};  // 0.13 ms a sub-step, 6.7 ms with the assembly
  c.sub_steps = 30.0;
  EXPECT_EQ(chooseMethod(c).method, "tled");
  c.sub_steps = 32.0;
  EXPECT_EQ(chooseMethod(c).method, "implicit_pcg");
}

TEST(MethodChoice, IsNotExplicitWhereThatWouldDoHarm) {
  CycleCounts c = usualCounts();
  c.sub_steps = 2.0;
  ASSERT_EQ(chooseMethod(c).method, "tled");
  CycleCounts other = c;
  other.poisson_ratio = 0.4901;
  EXPECT_EQ(chooseMethod(other).method, "implicit_pcg");
  EXPECT_TRUE(contains(chooseMethod(other).reason, "0.49"));
  other = c;
  other.explicit_accepts = false;
  EXPECT_EQ(chooseMethod(other).method, "implicit_pcg");
  EXPECT_TRUE(contains(chooseMethod(other).reason, "settings"));
  other = c;
  other.mass_damping = false;
  EXPECT_EQ(chooseMethod(other).method, "implicit_pcg");
  EXPECT_TRUE(contains(chooseMethod(other).reason, "ring"));
}

fem::Composition composition(const LiverSlab& slab) {
  return {{material::Solid{slab.law, slab.density, slab.prony}}, {}, {}};
}

CycleCounts countsOf(const LiverSlab& slab, ThreadPool* pool = nullptr) {
  FemBody body(slab.mesh, composition(slab), slab.free, slab.settings, pool);
  return countCycle(&body);
}

LiverSlab slabWith(double poisson_ratio, const std::string& element = "anp") {
  LiverSlab slab("auto", Eigen::Vector3i(8, 8, 4), element);
  slab.law = LiverSlab::liver("stable_neo_hookean", poisson_ratio);
  return slab;
}

TEST(CycleCounts, FollowTheBody) {
  const CycleCounts soft = countsOf(slabWith(0.45)), stiff = countsOf(slabWith(0.499));
  EXPECT_NEAR(soft.poisson_ratio, 0.45, 1e-9);
  EXPECT_NEAR(stiff.poisson_ratio, 0.499, 1e-9);
  EXPECT_EQ(soft.tets.number, 6.0 * 8 * 8 * 4);
  EXPECT_TRUE(soft.tets.averaged);
  EXPECT_FALSE(soft.tets.quadratic);
  EXPECT_GT(soft.volume_entries, soft.tets.number);
  EXPECT_GT(stiff.linear_iterations, 1.5 * soft.linear_iterations);
  EXPECT_GT(stiff.sub_steps, soft.sub_steps);
  EXPECT_EQ(soft.factor_nonzeros, stiff.factor_nonzeros);

  const CycleCounts tet4 = countsOf(slabWith(0.45, "tet4"));
  EXPECT_FALSE(tet4.tets.averaged);
  EXPECT_EQ(tet4.volume_entries, 0.0);
  EXPECT_LT(tet4.factor_flops, soft.factor_flops);  // that of anp reaches over two rings
  EXPECT_LT(tet4.direct, soft.direct);
  // The pressures' iterations plus the factor of the rest: far below the factor over two rings.
  EXPECT_LT(soft.direct, solver::factorizationSeconds(soft.factor_flops));
  const CycleCounts tet10p = countsOf(slabWith(0.45, "tet10p"));
  EXPECT_TRUE(tet10p.tets.quadratic && tet10p.tets.averaged);
  EXPECT_EQ(tet10p.tets.number, tet4.tets.number);

  LiverSlab longer = slabWith(0.45);
  longer.settings.step = 0.03;
  EXPECT_GE(countsOf(longer).linear_iterations, soft.linear_iterations);
  EXPECT_NEAR(countsOf(longer).sub_steps, 3.0 * soft.sub_steps, 3.0);
}

TEST(CycleCounts, SeeWhatTheExplicitMethodWouldRefuse) {
  LiverSlab slab = slabWith(0.45);
  EXPECT_TRUE(countsOf(slab).explicit_accepts);
  EXPECT_FALSE(countsOf(slab).mass_damping);
  slab.settings.mass_damping = 5.0;
  EXPECT_TRUE(countsOf(slab).mass_damping);
  slab.settings.stiffness_damping = 1e-3;
  EXPECT_FALSE(countsOf(slab).explicit_accepts);
  slab.settings.stiffness_damping = 0.0;
  for (const char* integrator : {"static", "bdf2"}) {
    slab.settings.integrator = integrator;
    EXPECT_FALSE(countsOf(slab).explicit_accepts) << integrator;
  }
}

TEST(CycleCounts, AreTheSameWithThreadsAndInEveryLoad) {
  ThreadPool two(2), three(3);
  for (const double poisson_ratio : {0.45, 0.499}) {
    const LiverSlab slab = slabWith(poisson_ratio);
    const std::vector<std::string> notes = slab.make()->notes();
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_TRUE(contains(notes[0], "method auto takes ")) << notes[0];
    EXPECT_EQ(slab.make()->notes(), notes);
    EXPECT_EQ(slab.make(&two)->notes(), notes);
    EXPECT_EQ(slab.make(&three)->notes(), notes);
  }
}

// Presses a slab by `auto` and by what that chose.
std::string expectSameBits(LiverSlab slab) {
  const std::string method = chooseMethod(countsOf(slab)).method;
  const auto chosen = slab.make();
  slab.settings.method = method;
  const auto named = slab.make();
  EXPECT_TRUE(named->notes().empty());
  EXPECT_EQ(chosen->positions(), named->positions());
  for (LiverPress a(0.01, 0.05), b(0.01, 0.05); a.time() < 0.25;) {
    const TissueStep& one = chosen->step({a.next()}, slab.settings.step);
    const TissueStep& other = named->step({b.next()}, slab.settings.step);
    EXPECT_EQ(one.linear_iterations, other.linear_iterations);
    EXPECT_EQ(one.elastic_energy, other.elastic_energy);
    if (chosen->positions() != named->positions()) {
      ADD_FAILURE() << method << " at " << a.time();
      break;
    }
  }
  return method;
}

TEST(MethodAuto, IsTheChosenMethodToTheBit) {
  LiverSlab slab = slabWith(0.45);
  slab.settings.gravity = Vec3(0.0, 0.0, -9.81);
  expectSameBits(slab);
  slab.prony = {{0.3, 0.1}};
  expectSameBits(slab);
  expectSameBits(slabWith(0.499));
  expectSameBits(slabWith(0.45, "p1p1"));
  for (const char* integrator : {"static", "bdf2"}) {
    LiverSlab other = slabWith(0.45);
    other.settings.integrator = integrator;
    EXPECT_NE(expectSameBits(other), "tled");
  }
}

// Coarse, so that a sub-step is long.
TEST(MethodAuto, GoesExplicitForSoftDampedTissue) {
  LiverSlab slab = slabWith(0.3, "tet4");
  slab.settings.mass_damping = 5.0;
  slab.settings.step = 0.002;
  EXPECT_EQ(expectSameBits(slab), "tled");
}

TEST(MethodAuto, ChoosesForEachPartOfAnOrgan) {
  LiverSlab slab = slabWith(0.45, "tet4");
  mesh::TetMesh two = slab.mesh;
  const auto n = static_cast<int>(two.numPoints());
  two.points.conservativeResize(3, 2 * n);
  two.points.rightCols(n) = two.points.leftCols(n).colwise() + Vec3(0.2, 0.0, 0.0);
  const Eigen::Index m = two.tets.cols();
  two.tets.conservativeResize(4, 2 * m);
  two.tets.rightCols(m) = two.tets.leftCols(m).array() + n;
  fem::FreeMask free(3, 2 * n);
  free << slab.free, slab.free;
  const auto organ = makeIslands(two, composition(slab), free, slab.settings);
  const std::vector<std::string> notes = organ->notes();
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_TRUE(contains(notes[1], "part 2 of 2")) << notes[1];
  EXPECT_TRUE(contains(notes[1], "method auto takes ")) << notes[1];
}

TEST(MethodNotes, NameAFactorThatIsLongerThanACycle) {
  LiverSlab slab = slabWith(0.499);
  slab.settings.method = "lbfgs";
  EXPECT_TRUE(slab.make()->notes().empty());
  slab.settings.step = 1e-7;
  const std::vector<std::string> notes = slab.make()->notes();
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_TRUE(contains(notes[0], "lbfgs: a cycle of 1e-07 s waits for a factor")) << notes[0];
  for (const char* other : {"implicit_pcg", "implicit_async"}) {
    slab.settings.method = other;
    EXPECT_TRUE(slab.make()->notes().empty()) << other;
  }
}

}  // namespace
}  // namespace palpate::tissue::method_choice_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/method_facts.h"

#include <gtest/gtest.h>

#include <regex>

#include "liver_slab.h"
#include "support/contains.h"
#include "tissue/methods/method_choice.h"

namespace palpate::tissue::method_facts_test {
namespace {

using solver::LinearSystems;
using test::contains;
using test::LiverSlab;

std::string refusal(const LiverSlab& slab) {
  try {
    slab.make();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(MethodFacts, AreKnownOfEveryMethodAndOfNoOther) {
  for (const std::string& name : methodNames()) EXPECT_EQ(methodFacts(name).name, name);
  try {
    methodFacts("implicit_magic");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(contains(error.what(), "method = implicit_magic: must be one of implicit_pcg, "));
  }
}

// The figures of a short press say how the linear systems were solved.
TEST(MethodFacts, FitWhatAMethodDoes) {
  int by_iterations = 0;  // of the first method, which has nothing else
  for (const std::string& name : methodNames()) {
    if (name == "auto") continue;
    const MethodFacts facts = methodFacts(name);
    const auto tissue = LiverSlab(name, Eigen::Vector3i(4, 4, 2), "tet4").make();
    int linear = 0;
    for (test::LiverPress press(0.005, 0.1); press.time() < 0.1;) {
      linear += tissue->step({press.next()}, 0.01).linear_iterations;
    }
    if (facts.linear_systems == LinearSystems::kIterations) {
      EXPECT_GT(linear, 0) << name;
      if (by_iterations == 0) by_iterations = linear;
    }
    if (facts.linear_systems == LinearSystems::kFactor) {
      EXPECT_LT(linear, by_iterations / 2) << name;
    }
    if (facts.linear_systems == LinearSystems::kNone) {
      EXPECT_EQ(linear, 0) << name;
    }
    EXPECT_EQ(facts.explicit_steps, facts.linear_systems == LinearSystems::kNone) << name;
    EXPECT_EQ(tissue->methods(0), std::vector<std::string>{name});
  }
}

TEST(MethodFacts, SayWhichMethodsWaitForFactorisations) {
  for (const char* name : {"implicit_direct", "implicit_async", "lbfgs"}) {
    EXPECT_TRUE(methodFacts(name).wants_fast_blas) << name;
  }
  for (const char* name : {"implicit_pcg", "tled", "newton_bicgstab"}) {
    EXPECT_FALSE(methodFacts(name).wants_fast_blas) << name;
  }
}

TEST(MethodFacts, SayWhatEachMethodTakes) {
  for (const std::string& name : methodNames()) {
    const MethodFacts facts = methodFacts(name);
    for (const std::string& integrator : solver::integratorNames()) {
      LiverSlab slab(name, Eigen::Vector3i(2, 2, 1), "tet4");
      slab.settings.integrator = integrator;
      const bool takes = std::count(facts.integrators.begin(), facts.integrators.end(), integrator);
      const std::string told = refusal(slab);
      EXPECT_EQ(told.empty(), takes) << name << ": " << told;
      if (!takes) {
        EXPECT_EQ(told.find("integrator = " + integrator + ": method " + name + " "), 0u) << told;
        EXPECT_TRUE(contains(told, "leave the key out or choose an implicit method")) << told;
      }
    }
    LiverSlab viscous(name, Eigen::Vector3i(2, 2, 1), "tet4");
    viscous.prony = {{0.3, 0.1}};
    EXPECT_EQ(refusal(viscous).empty(), facts.viscous) << name << ": " << refusal(viscous);
    LiverSlab damped(name, Eigen::Vector3i(2, 2, 1), "tet4");
    damped.settings.stiffness_damping = 0.5;
    EXPECT_EQ(refusal(damped).empty(), facts.stiffness_damping) << name << ": " << refusal(damped);
  }
  EXPECT_FALSE(methodFacts("tled").stiffness_damping);
  EXPECT_FALSE(methodFacts("linear_precomputed").viscous);
}

TEST(MethodFacts, AutoChoosesAmongThoseThatAreForIt) {
  CycleCounts counts;
  counts.tets.number = counts.blocks = 1e4;
  counts.linear_iterations = 10;
  counts.factor_flops = counts.factor_nonzeros = 1e6;
  counts.sub_steps = 10.0;
  const std::string reason = chooseMethod(counts).reason;
  for (const std::string& name : methodNames()) {
    const bool estimated = std::regex_search(reason, std::regex("[ :]" + name + " [0-9.e-]+ ms"));
    EXPECT_EQ(estimated, methodFacts(name).for_auto) << name << " in " << reason;
  }
}

TEST(MethodFacts, TheModelSaysWhatAutoTook) {
  LiverSlab stiff("auto", Eigen::Vector3i(8, 8, 4));
  stiff.law = LiverSlab::liver("stable_neo_hookean", 0.499);
  const auto tissue = stiff.make();
  ASSERT_EQ(tissue->methods(0).size(), 1u);
  const std::string taken = tissue->methods(0)[0];
  EXPECT_TRUE(methodFacts(taken).for_auto) << taken;
  EXPECT_TRUE(contains(tissue->notes().at(0), "method auto takes " + taken + ","));
}

}  // namespace
}  // namespace palpate::tissue::method_facts_test

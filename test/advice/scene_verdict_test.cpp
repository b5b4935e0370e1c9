// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/advice/scene_verdict.h"

#include <gtest/gtest.h>

#include "palpate/tissue/fem/fem_tissue.h"
#include "sim/slab_scene.h"
#include "support/contains.h"

namespace palpate::advice::scene_verdict_test {
namespace {

using test::contains;

sim::StepReport report(Phase costly, double seconds, int newton = 2, int linear = 40) {
  sim::StepReport r;
  for (std::size_t k = 0; k < kNumCyclePhases; ++k) r.phases[static_cast<Phase>(k)] = 1e-4;
  r.phases[costly] = seconds;
  r.newton_iterations = newton;
  r.linear_iterations = linear;
  return r;
}

CycleCosts figuresOf(const sim::StepReport& r, int count = 100) {
  CostRecorder recorder;
  for (int k = 0; k < count; ++k) recorder.add(r, r.phases.cycle());
  return recorder.figures();
}

// Of a scene that says nothing else.
SceneFacts usualFacts() {
  SceneFacts facts;
  facts.organ = "liver";
  facts.edge_length = 0.01;
  facts.meshed = true;
  facts.poisson_ratio = 0.45;
  return facts;
}

bool advises(const SceneVerdict& verdict, const std::string& word) {
  for (const Advice& advice : verdict.advice) {
    if (contains(advice.text, word)) return true;
  }
  return false;
}

TEST(CostRecorder, TakesPercentilesAndTheSlowestCycles) {
  CostRecorder recorder;
  EXPECT_EQ(recorder.figures().cycles, 0);
  for (int k = 1; k <= 100; ++k) {
    sim::StepReport r = report(Phase::kAssembly, 1e-3 * k, k % 2, 10 * (k % 2));
    r.skipped.far_bodies = 3;
    recorder.add(r, 1.0 * k);
  }
  const CycleCosts f = recorder.figures();
  EXPECT_EQ(f.cycles, 100);
  EXPECT_DOUBLE_EQ(f.cycle_median, 50.0);
  EXPECT_DOUBLE_EQ(f.cycle_p99, 99.0);
  EXPECT_DOUBLE_EQ(f.median[Phase::kAssembly], 0.050);
  EXPECT_DOUBLE_EQ(f.p99[Phase::kAssembly], 0.099);
  EXPECT_NEAR(f.slow[Phase::kAssembly], 0.098, 1e-12);  // of 96 .. 100
  EXPECT_NEAR(f.total[Phase::kAssembly], 5.050, 1e-12);
  EXPECT_DOUBLE_EQ(f.newton_per_cycle, 0.5);
  EXPECT_DOUBLE_EQ(f.linear_per_newton, 10.0);
  EXPECT_EQ(f.skipped.far_bodies, 300);
  recorder.clear();
  EXPECT_EQ(recorder.figures().cycles, 0);
}

TEST(CostRecorder, ASumOverPartsIsThatManyCycles) {
  CostRecorder recorder;
  recorder.add(report(Phase::kAssembly, 6e-3, 4, 80), 9e-3, 2);
  const CycleCosts f = recorder.figures();
  EXPECT_EQ(f.cycles, 2);
  EXPECT_DOUBLE_EQ(f.cycle_p99, 4.5e-3);
  EXPECT_DOUBLE_EQ(f.slow[Phase::kAssembly], 3e-3);
  EXPECT_DOUBLE_EQ(f.newton_per_cycle, 2.0);
  recorder.add(report(Phase::kAssembly, 6e-3), 9e-3, 0);
  EXPECT_EQ(recorder.figures().cycles, 2);
}

TEST(SceneVerdict, ALightSceneNeedsNoAdvice) {
  const SceneVerdict verdict = judgeScene(usualFacts(), figuresOf(report(Phase::kAssembly, 3e-3)));
  EXPECT_FALSE(verdict.too_heavy);
  EXPECT_NEAR(verdict.rate_possible, 1.0 / 3.5e-3, 1.0);
  EXPECT_EQ(verdict.costliest, Phase::kAssembly);
  EXPECT_NEAR(verdict.share, 3.0 / 3.5, 1e-9);
  EXPECT_TRUE(verdict.advice.empty());
  EXPECT_TRUE(contains(longText(verdict), "too heavy for 100 Hz?  no"));
  EXPECT_TRUE(contains(shortText(verdict), "286 Hz, 100 Hz are wanted"));
}

TEST(SceneVerdict, KnowsNothingWithoutCycles) {
  const SceneVerdict verdict = judgeScene(usualFacts(), CycleCosts());
  EXPECT_FALSE(verdict.too_heavy);
  EXPECT_EQ(verdict.rate_possible, 0.0);
  EXPECT_EQ(shortText(verdict), "no cycle was measured");
  EXPECT_NE(longText(verdict), "");
}

TEST(SceneVerdict, SaysHowMuchCoarserAMeshHasToBe) {
  SceneFacts facts = usualFacts();
  const SceneVerdict verdict = judgeScene(facts, figuresOf(report(Phase::kLinearSolve, 30e-3)));
  ASSERT_TRUE(verdict.too_heavy);
  EXPECT_EQ(verdict.costliest, Phase::kLinearSolve);
  ASSERT_TRUE(advises(verdict, "raise edge_length of organ liver, whose edges are now 0.01 m to "));
  EXPECT_TRUE(contains(verdict.advice.front().text, "edge_length"));  // the most effective
  EXPECT_NEAR(verdict.advice.front().cycle, 1.0 / facts.rates.simulation, 1e-4);
  // (30 / 9.8)^(1/4) = 1.32 times as long edges
  EXPECT_TRUE(contains(verdict.advice.front().text, "to 0.013 m"));
  // Assembly shrinks with the nodes only: (30 / 9.8)^(1/3) = 1.45.
  const SceneVerdict assembly = judgeScene(facts, figuresOf(report(Phase::kAssembly, 30e-3)));
  EXPECT_TRUE(contains(assembly.advice.front().text, "to 0.015 m"));
  // What no coarser mesh makes fast enough is estimated as it is.
  const SceneVerdict hopeless = judgeScene(facts, figuresOf(report(Phase::kAssembly, 10.0)));
  EXPECT_GT(hopeless.advice.front().cycle, 10.0 / facts.rates.simulation);
  facts.graded = true;
  EXPECT_TRUE(
      advises(judgeScene(facts, figuresOf(report(Phase::kAssembly, 30e-3))),
              "raise coarsest and finest in edge_length of organ liver by a factor of 1.5"));
  facts.graded = facts.meshed = false;
  EXPECT_TRUE(advises(judgeScene(facts, figuresOf(report(Phase::kAssembly, 30e-3))),
                      "give organ liver a coarser mesh"));
  // (17.3 / 9.8)^(1 / 0.75) = 2.13
  facts.finest = 0.002;
  EXPECT_TRUE(advises(judgeScene(facts, figuresOf(report(Phase::kAssembly, 17.3e-3))),
                      "raise adapt.finest of organ liver from 0.002 m to 0.0043 m"));
}

TEST(SceneVerdict, AdviceFitsThePhaseThatCosts) {
  SceneFacts facts = usualFacts();
  facts.poisson_ratio = 0.49;
  facts.solver.linear_tolerance = 1e-4;
  const SceneVerdict linear =
      judgeScene(facts, figuresOf(report(Phase::kLinearSolve, 30e-3, 2, 400)));
  EXPECT_TRUE(advises(linear, "poisson_ratio from 0.49 to 0.45"));
  EXPECT_TRUE(advises(linear, "linear_tolerance from 0.0001 to 0.01"));
  EXPECT_TRUE(advises(linear, "implicit_async"));
  EXPECT_FALSE(advises(linear, "contact.sample_spacing"));
  EXPECT_FALSE(advises(linear, "contact.stiffness"));
  EXPECT_FALSE(advises(linear, "threads"));

  const SceneVerdict contact = judgeScene(facts, figuresOf(report(Phase::kContact, 30e-3, 6, 60)));
  EXPECT_TRUE(contains(contact.advice.front().text, "contact.sample_spacing"));
  EXPECT_FALSE(advises(contact, "poisson_ratio"));

  const SceneVerdict newton = judgeScene(facts, figuresOf(report(Phase::kAssembly, 30e-3, 6, 60)));
  EXPECT_TRUE(advises(newton, "take contact.model: penalty"));
  facts.contact.model = "penalty";
  const SceneVerdict of_penalty =
      judgeScene(facts, figuresOf(report(Phase::kAssembly, 30e-3, 6, 60)));
  EXPECT_TRUE(advises(of_penalty, "lower contact.stiffness from 300000000 to 75000000"));

  facts.cores = 2;
  facts.nodes = 999;  // too few to share
  EXPECT_FALSE(
      advises(judgeScene(facts, figuresOf(report(Phase::kAssembly, 30e-3))), "threads: 2"));
  facts.nodes = 1000;
  EXPECT_TRUE(advises(judgeScene(facts, figuresOf(report(Phase::kAssembly, 30e-3))), "threads: 2"));
  facts.method = tissue::methodFacts("implicit_direct");
  const SceneVerdict direct = judgeScene(facts, figuresOf(report(Phase::kLinearSolve, 30e-3)));
  EXPECT_TRUE(advises(direct, "solver.method: implicit_pcg"));
  EXPECT_FALSE(advises(direct, "poisson_ratio from"));
  EXPECT_FALSE(advises(direct, "threads"));
}

TEST(SceneVerdict, ALongerStepAlwaysHelpsAndStandsLast) {
  const SceneVerdict verdict = judgeScene(usualFacts(), figuresOf(report(Phase::kAssembly, 30e-3)));
  EXPECT_TRUE(contains(verdict.advice.back().text, "solver.step: 0.031, rates.simulation: 32"));
  EXPECT_TRUE(contains(longText(verdict), "yes, by a factor of 3.05"));
  EXPECT_TRUE(contains(longText(verdict), "30.5 ms: or leave the scene"));
  EXPECT_FALSE(
      advises(judgeScene(usualFacts(), figuresOf(report(Phase::kAssembly, 0.2))), "solver.step"));
}

TEST(SceneVerdict, ProfileTableHasEveryPhaseAndCounter) {
  sim::StepReport r = report(Phase::kContact, 2.5e-3, 3, 60);
  r.skipped.sleeping_organs = 1;
  const std::string table = profileTable(figuresOf(r, 10));
  for (const char* word :
       {"contact            2.500     2.500  83.3 %", "forces", "assembly", "linear_solve",
        "line_search", "other", "Newton iterations per step 3.00",
        "linear iterations per Newton iteration 20.00", "skipped in 10 steps", "far_bodies 0",
        "sleeping_organs 10", "distant_samples 0"}) {
    EXPECT_TRUE(contains(table, word)) << word << "\n" << table;
  }
  EXPECT_FALSE(contains(table, "haptics"));
}

void expectScene(const SceneFacts& facts, const scene::Scene& scene) {
  EXPECT_EQ(facts.rates.simulation, scene.rates.simulation);
  EXPECT_EQ(facts.solver.method, scene.solver.method);
  EXPECT_EQ(facts.solver.step, scene.solver.step);
  EXPECT_EQ(facts.solver.threads, scene.solver.threads);
  EXPECT_EQ(facts.solver.linear_tolerance, scene.solver.linear_tolerance);
  EXPECT_EQ(facts.contact.stiffness, scene.contact.stiffness);
  EXPECT_EQ(facts.contact.sample_spacing, scene.contact.sample_spacing);
}

TEST(SceneFacts, AreThoseOfADefaultSceneBeforeAnySceneIsRead) {
  expectScene(SceneFacts(), scene::Scene());
}

TEST(SceneFacts, AreThoseOfTheSceneAndItsMesh) {
  const test::SlabScene slab;
  const sim::Simulator simulator(
      slab.scene("solver: {threads: 2, step: 0.02, linear_tolerance: 0.03}\n"
                 "rates: {simulation: 50}\ncontact: {stiffness: 1.0e7, sample_spacing: 0.004}"));
  const SceneFacts facts = sceneFacts(simulator, 4);
  expectScene(facts, simulator.scene());
  EXPECT_EQ(facts.rates.simulation, 50.0);
  EXPECT_EQ(facts.cores, 4);
  EXPECT_EQ(facts.organ, "slab");
  EXPECT_EQ(facts.nodes, 7 * 7 * 4);
  EXPECT_FALSE(facts.meshed);
  EXPECT_GT(facts.edge_length, 0.013);
  EXPECT_LT(facts.edge_length, 0.03);
  EXPECT_NEAR(facts.poisson_ratio, 0.45, 1e-9);
  EXPECT_EQ(facts.method.name, "implicit_pcg");
}

// Advice is on what `auto` took, and names methods that there are.
TEST(SceneFacts, HaveTheMethodThatAutoTook) {
  const test::SlabScene slab;
  const sim::Simulator simulator(slab.scene("solver: {method: auto}"));
  SceneFacts facts = sceneFacts(simulator, 1);
  EXPECT_EQ(facts.solver.method, "auto");
  ASSERT_EQ(simulator.methods(0).size(), 1u);
  EXPECT_EQ(facts.method.name, simulator.methods(0)[0]);
  EXPECT_TRUE(facts.method.for_auto);
  EXPECT_EQ(simulator.wantsFastBlas(), facts.method.wants_fast_blas);

  const CycleCosts slow = figuresOf(report(Phase::kLinearSolve, 0.5, 2, 400));
  facts.method = tissue::methodFacts("implicit_pcg");
  EXPECT_TRUE(advises(judgeScene(facts, slow), "solver.method: implicit_async"));
  facts.method = tissue::methodFacts("implicit_direct");
  EXPECT_TRUE(advises(judgeScene(facts, slow), "solver.method: implicit_pcg"));
  for (const char* named : {"implicit_async", "implicit_pcg"}) {
    EXPECT_EQ(tissue::methodFacts(named).name, named);
  }
}

}  // namespace
}  // namespace palpate::advice::scene_verdict_test

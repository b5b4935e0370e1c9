// SPDX-License-Identifier: GPL-3.0-or-later
// Springs in a scene: the same force at rest whatever the integrator, steps that are stable, a
// region that moves alone, and what is refused.
#include <gtest/gtest.h>

#include <functional>

#include "model_variants.h"
#include "palpate/springs/springs_file.h"
#include "support/temp_folder.h"
#include "tissue/models/springs/tet_network.h"

namespace palpate::tissue::mass_spring_test {
namespace {

using test::kStep;
using test::ModelVariant;
using test::onTool;
using test::Visit;

struct Held {
  double force = 0.0;
  int still = 0;
};

// At the end of two seconds under the ball.
Held hold(const ModelVariant& variant, const std::function<void(test::OrganSketch*)>& change = {}) {
  test::OrganSketch organ = test::variantBlock(variant);
  if (change) change(&organ);
  const auto tissue = test::makeVariant(variant, organ, test::variantSettings());
  Held held;
  for (Visit visit(0.004, 1e9); visit.time() < 2.0;) {
    const TissueStep& step = tissue->step({visit.next()}, kStep);
    held = {onTool(step).z(), step.still_points};
  }
  return held;
}

TEST(MassSpring, HasOneForceAtRestWhateverTheIntegrator) {
  std::vector<ModelVariant> variants = test::modelVariants();
  const double implicit = hold(variants.front()).force;
  EXPECT_GT(implicit, 0.1);
  for (const ModelVariant& variant : variants) {
    if (variant.model != "mass_spring" || variant.springs.region > 0.0) continue;
    EXPECT_NEAR(hold(variant).force, implicit, 2e-3 * implicit) << variant.name;
  }
}

TEST(MassSpring, MovesOnlyTheRegionThatIsTouched) {
  const ModelVariant all = test::springVariant("all", "symplectic_euler");
  const Held whole = hold(all);
  EXPECT_EQ(whole.still, 0);
  double last = 0.0;
  for (const double radius : {0.015, 0.025, 0.04}) {
    ModelVariant part = all;
    part.springs.region = radius;
    const Held some = hold(part);
    EXPECT_GT(some.still, 0);
    // What is left where it is makes it stiffer, the more so the smaller the region.
    EXPECT_GT(some.force, 0.999 * whole.force);
    if (last > 0.0) {
      EXPECT_LT(some.force, last);
    }
    last = some.force;
  }
  EXPECT_LT(last, 1.03 * whole.force);
}

// Volumes, a fit, and the same from a file; in the block's regular tetrahedra they are not the
// same.
TEST(MassSpring, TakesItsConstantsFromVolumesAFitOrAFile) {
  ModelVariant variant = test::springVariant("x", "implicit");
  const double by_volumes = hold(variant).force;
  variant.springs.constants = "fitted";
  const double fitted = hold(variant).force;
  EXPECT_GT(fitted, 0.3 * by_volumes);
  EXPECT_LT(fitted, 1.5 * by_volumes);

  const test::TempFolder folder;
  const test::OrganSketch organ = test::variantBlock(variant);
  const fem::Composition composition{{organ.solid}, {}, {}};
  std::vector<std::string> notes;
  springs::SpringNetwork network =
      tetNetwork(organ.mesh, Pose::Identity(), composition, variant.springs, &notes);
  EXPECT_EQ(notes.size(), 1U);
  variant.springs.constants = "file";
  variant.springs.file = folder.path("springs.csv");
  springs::writeSprings(variant.springs.file, network);
  EXPECT_EQ(hold(variant).force, fitted);

  network.points.col(3).x() += 0.001;  // a ninetieth of the block
  springs::writeSprings(variant.springs.file, network);
  EXPECT_THROW(hold(variant), std::invalid_argument);
}

TEST(MassSpring, IsSteppedNoLongerThanIsStable) {
  const ModelVariant explicitly = test::springVariant("x", "symplectic_euler");
  const double force = hold(explicitly).force;
  ModelVariant short_steps = explicitly;
  short_steps.springs.step = 2e-4;
  EXPECT_NEAR(hold(short_steps).force, force, 2e-3 * force);
}

// In explicit steps, after one of them, and the next cycles go on from there.
TEST(MassSpring, EndsACycleWhereItIsAskedTo) {
  const solver::Interrupt at_once = [] { return true; };
  for (const std::string& scheme : tissue::springSchemeNames()) {
    if (scheme == "implicit") continue;
    const ModelVariant variant = test::springVariant("x", scheme);
    const auto tissue =
        test::makeVariant(variant, test::variantBlock(variant), test::variantSettings());
    Visit visit;
    for (int k = 0; k < 10; ++k) tissue->step({visit.next()}, kStep);
    const Points before = tissue->positions();
    tissue->setInterrupt(&at_once);
    const TissueStep& late = tissue->step({visit.next()}, kStep);
    EXPECT_EQ(late.status, solver::SolveStatus::kDeadline) << scheme;
    EXPECT_GT(late.sweep_stages, 5) << scheme;
    EXPECT_EQ(late.time_steps, 1) << scheme;
    const double way = (tissue->positions() - before).cwiseAbs().maxCoeff();
    EXPECT_GT(way, 0.0) << scheme;
    EXPECT_LT(way, 2e-3 * kStep / 0.01) << scheme;
    tissue->setInterrupt(nullptr);
    for (int k = 0; k < 10; ++k) {
      EXPECT_NE(tissue->step({visit.next()}, kStep).status, solver::SolveStatus::kDeadline);
    }
    EXPECT_GT(onTool(tissue->step({visit.next()}, kStep)).z(), 0.05) << scheme;
  }
}

std::string refusal(const ModelVariant& variant,
                    const std::function<void(test::OrganSketch*)>& change) {
  try {
    hold(variant, change);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(MassSpring, RefusesWhatSpringsCannotBe) {
  const auto nothing = [](test::OrganSketch*) {};
  const auto with = [](const std::string& scheme, double step) {
    return test::springVariant("x", scheme, step);
  };
  const auto says = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  const std::string too_long = refusal(with("symplectic_euler", 0.5), nothing);
  EXPECT_TRUE(says(too_long, "springs.step = 0.5") && says(too_long, "is stable up to"))
      << too_long;
  const std::string too_many = refusal(with("symplectic_euler", 1e-8), nothing);
  EXPECT_TRUE(says(too_many, "solver.step = 0.01") && says(too_many, "of its steps of 1e-08 s"))
      << too_many;
  for (const char* name : {"forward_euler", "trapezoidal_euler"}) {
    const std::string undamped = refusal(with(name, 0.0), [](test::OrganSketch* organ) {
      organ->damping = {0.0, 0.0};
    });
    EXPECT_TRUE(says(undamped, "damping.mass")) << undamped;
  }
  const ModelVariant implicit = with("implicit", 0.0);
  EXPECT_TRUE(says(refusal(implicit, [](test::OrganSketch* organ) { organ->adapt.finest = 0.002; }),
                   "adapt"));
  EXPECT_TRUE(says(refusal(implicit,
                           [](test::OrganSketch* organ) {
                             organ->solid.prony = {{0.3, 0.1}};
                           }),
                   "viscoelastic"));
  EXPECT_TRUE(says(refusal(with("euler", 0.0), nothing), "must be one of"));
  EXPECT_TRUE(says(refusal(implicit,
                           [](test::OrganSketch* organ) {
                             organ->mesh.points.col(organ->mesh.tets(0, 0)) =
                                 organ->mesh.points.col(organ->mesh.tets(1, 0));
                           }),
                   "no volume"));
}

}  // namespace
}  // namespace palpate::tissue::mass_spring_test

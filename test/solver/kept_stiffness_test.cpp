// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/kept_stiffness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "palpate/fem/elasticity.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/solver/block_pcg.h"
#include "palpate/solver/inertia.h"
#include "palpate/solver/newton.h"
#include "support/contains.h"
#include "support/random.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"

namespace palpate::solver::kept_stiffness_test {
namespace {

// Springs between a node and its neighbours on the diagonal, here and there as it moves on.
struct Spring final : fem::EnergyTerm {
  int node = 0;
  double value(const Points&) const override { return 0.0; }
  double addGradient(const Points&, Points*) const override { return 0.0; }
  void addHessian(const Points&, fem::Tangent, fem::Stiffness* K) const override {
    const Mat3 k = 3.0 * Mat3::Identity() + Mat3::Ones();
    const fem::BlockMatrix& pattern = K->blocks();
    for (int slot = pattern.rowBegin(node); slot < pattern.rowEnd(node); ++slot) {
      const int j = pattern.column(slot);
      if (j == node) continue;
      K->add(node, node, k);
      K->add(j, j, k);
      K->add(node, j, -k);
      K->add(j, node, -k);
    }
  }
};

struct Body {
  mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.1, 0.1, 0.1), Eigen::Vector3i::Constant(3));
  std::unique_ptr<fem::Elasticity> elasticity;
  Spring spring;
  Inertia inertia;
  Potential potential;

  explicit Body(const std::string& element, const std::vector<material::PronyTerm>& prony = {})
      : elasticity(fem::makeElasticity(
            element, mesh,
            {{{material::makeMaterial("stable_neo_hookean",
                                      {{"young_modulus", {5e3}}, {"poisson_ratio", {0.45}}}),
               1000.0, prony}},
             {},
             {}})),
        potential{
            elasticity.get(), {&spring, &inertia}, fem::FreeMask::Ones(3, mesh.numPoints()), 1.25} {
    inertia.beginStep(mesh.points, 1e4, elasticity->masses());
    potential.free.leftCols(16).setZero();
    potential.free(1, 20) = 0.0;
  }
  // The elastic part at x_elastic, all else at x.
  fem::Stiffness expected(const Points& x_elastic, const Points& x) const {
    fem::Stiffness A = elasticity->makeMatrix();
    elasticity->hessian(x_elastic, fem::Tangent::kExact, &A);
    A.scale(potential.elastic_scale);
    potential.addTermHessians(x, fem::Tangent::kExact, &A);
    A.constrain(potential.free);
    return A;
  }
};

bool sameBlocks(const fem::Stiffness& A, const fem::Stiffness& B) {
  const double* a = A.blocks().values();
  return std::equal(a, a + 9L * A.blocks().numBlocks(), B.blocks().values()) &&
         (!A.hasVolume() ||
          (A.volume().rows == B.volume().rows && A.volume().factor == B.volume().factor));
}

class Kept : public testing::TestWithParam<const char*> {};

TEST_P(Kept, IsTheMatrixOfNowButForTheElasticPart) {
  test::Random random;
  Body body(GetParam());
  fem::Stiffness A = body.elasticity->makeMatrix();
  KeptStiffness kept(A);
  const Points X = body.mesh.points;
  EXPECT_FALSE(kept.hessian(body.potential, X, fem::Tangent::kExact, &A).kept);
  EXPECT_TRUE(sameBlocks(A, body.expected(X, X)));
  for (int k = 1; k <= 8; ++k) {
    const fem::Stiffness before = A;
    const Points x = X + random.points(body.mesh.numPoints(), 1e-4);
    body.spring.node = 7 * k % 60;
    if (k == 3) body.potential.elastic_scale = 1.5;
    if (k == 5) body.potential.free.col(30).setZero();
    if (k == 6) body.inertia.beginStep(X, 3e4, body.elasticity->masses());
    const auto assembled = kept.hessian(body.potential, x, fem::Tangent::kExact, &A);
    EXPECT_TRUE(assembled.kept);
    EXPECT_TRUE(sameBlocks(A, body.expected(X, x))) << k;
    EXPECT_EQ(assembled.changed == nullptr, k == 3 || k == 5);
    if (!assembled.changed) continue;
    const fem::BlockMatrix& blocks = A.blocks();
    for (int i = 0; i < blocks.numNodes(); ++i) {
      for (int slot = blocks.rowBegin(i); slot < blocks.rowEnd(i); ++slot) {
        if (slot == blocks.diagonal(i) || blocks.block(slot) == before.blocks().block(slot)) {
          continue;
        }
        const auto& changed = *assembled.changed;
        EXPECT_TRUE(std::find(changed.begin(), changed.end(), slot) != changed.end());
      }
    }
  }
}

TEST_P(Kept, IsAssembledAnewWhereTheBodyChangesItsShape) {
  Body body(GetParam());
  fem::Stiffness A = body.elasticity->makeMatrix();
  KeptStiffness kept(A);
  const Points X = body.mesh.points;
  kept.hessian(body.potential, X, fem::Tangent::kExact, &A);
  Points x = X;
  x(0, 40) += 0.01;
  EXPECT_FALSE(kept.hessian(body.potential, x, fem::Tangent::kExact, &A).kept);
  EXPECT_TRUE(sameBlocks(A, body.expected(x, x)));
  kept.drop();
  EXPECT_FALSE(kept.hessian(body.potential, x, fem::Tangent::kExact, &A).kept);
}

TEST_P(Kept, IsKeptOverMoreWithinItsCycle) {
  Body body(GetParam());
  fem::Stiffness A = body.elasticity->makeMatrix();
  KeptStiffness kept(A);
  const Points X = body.mesh.points;
  const auto keptAt = [&](double strain) {
    return kept.hessian(body.potential, (1.0 + strain) * X, fem::Tangent::kExact, &A).kept;
  };
  kept.beginCycle();
  EXPECT_FALSE(keptAt(0.0));
  EXPECT_TRUE(keptAt(0.9 * KeptStiffness::kMostStrainInCycle));
  EXPECT_FALSE(keptAt(1.1 * KeptStiffness::kMostStrainInCycle));
  kept.drop();
  EXPECT_FALSE(keptAt(0.0));
  kept.beginCycle();
  EXPECT_TRUE(keptAt(0.9 * KeptStiffness::kMostStrain));
  EXPECT_FALSE(keptAt(1.1 * KeptStiffness::kMostStrain));
}

TEST_P(Kept, OfAViscousBodyIsThatOfTheMemoryOfThen) {
  test::Random random;
  Body body(GetParam(), {{0.4, 0.05}});
  fem::Stiffness A = body.elasticity->makeMatrix();
  KeptStiffness kept(A);
  const Points X = body.mesh.points;
  const auto step = [&] {
    body.elasticity->endStep(X + random.points(body.mesh.numPoints(), 1e-3));
    body.elasticity->beginStep(0.01);
  };
  step();
  const fem::Stiffness then = body.expected(X, X);
  EXPECT_FALSE(kept.hessian(body.potential, X, fem::Tangent::kExact, &A).kept);
  EXPECT_TRUE(sameBlocks(A, then));
  step();
  EXPECT_FALSE(sameBlocks(body.expected(X, X), then));
  EXPECT_TRUE(kept.hessian(body.potential, X, fem::Tangent::kExact, &A).kept);
  EXPECT_TRUE(sameBlocks(A, then));

  StateWriter saved, again;
  kept.save(&saved);
  KeptStiffness restored(A);
  StateReader in(saved.bytes());
  restored.restore(&in);
  in.finish();
  restored.save(&again);
  EXPECT_EQ(again.bytes(), saved.bytes());
  EXPECT_TRUE(restored.hessian(body.potential, X, fem::Tangent::kExact, &A).kept);
  EXPECT_TRUE(sameBlocks(A, then));
}

TEST_P(Kept, MatrixThatSomebodyElseWroteIntoIsFilledWhole) {
  Body body(GetParam());
  fem::Stiffness A = body.elasticity->makeMatrix();
  KeptStiffness kept(A);
  const Points X = body.mesh.points;
  kept.hessian(body.potential, X, fem::Tangent::kExact, &A);
  A.scale(2.0);
  kept.matrixWasOverwritten();
  const auto assembled = kept.hessian(body.potential, X, fem::Tangent::kExact, &A);
  EXPECT_TRUE(assembled.kept);
  EXPECT_EQ(assembled.changed, nullptr);
  EXPECT_TRUE(sameBlocks(A, body.expected(X, X)));
}

TEST_P(Kept, ProjectedTangentsAreNotKept) {
  Body body(GetParam());
  fem::Stiffness A = body.elasticity->makeMatrix();
  KeptStiffness kept(A);
  const Points X = body.mesh.points;
  kept.hessian(body.potential, X, fem::Tangent::kExact, &A);
  EXPECT_FALSE(kept.hessian(body.potential, X, fem::Tangent::kProjected, &A).kept);
  const auto assembled = kept.hessian(body.potential, X, fem::Tangent::kExact, &A);
  EXPECT_TRUE(assembled.kept);
  EXPECT_EQ(assembled.changed, nullptr);
  EXPECT_TRUE(sameBlocks(A, body.expected(X, X)));
}

// Conjugate gradients on a matrix of which only what has changed is packed, and on all of it.
TEST_P(Kept, SolvesWithWhatHasChangedToTheSameBits) {
  test::Random random;
  Body body(GetParam());
  fem::Stiffness A = body.elasticity->makeMatrix();
  KeptStiffness kept(A);
  BlockPcg pcg(1000);
  for (int k = 0; k < 6; ++k) {
    const Points x = body.mesh.points + random.points(body.mesh.numPoints(), 1e-4);
    body.spring.node = 7 * k % 60;
    if (k == 4) body.inertia.beginStep(x, 3e4, body.elasticity->masses());
    const auto assembled = kept.hessian(body.potential, x, fem::Tangent::kExact, &A);
    EXPECT_EQ(assembled.changed != nullptr, k > 0);
    if (assembled.changed) pcg.onlyChanged(*assembled.changed);
    const Points b = random.points(x.cols(), 1.0).cwiseProduct(body.potential.free);
    Points y, all;
    EXPECT_EQ(pcg.solve(A, b, 1e-3, &y).status, SolveStatus::kConverged);
    BlockPcg(1000).solve(A, b, 1e-3, &all);
    EXPECT_EQ(y, all) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Elements, Kept, testing::Values("tet4", "anp"),
                         [](const auto& element) { return std::string(element.param); });

// Between a matrix, of a body that is as before or bent, and its solve: what goes on has the bits
// of what was restored.
TEST(KeptStiffness, OfACycleThatIsCutLeavesNothingBehind) {
  for (const double bent : {0.0, 0.01}) {
    test::Random random;
    Body body("tet4");
    const auto solve = [&](Newton* newton, int node, Points x, const Interrupt* interrupt) {
      NewtonSettings settings;
      settings.tolerance = 0.0;
      settings.max_iterations = 1;
      settings.least_iterations = 0;
      settings.linear_tolerance = 1e-3;
      settings.interrupt = interrupt;
      body.spring.node = node;
      newton->beginCycle(0.01);
      EXPECT_EQ(newton->minimize(body.potential, settings, &x).status,
                interrupt ? SolveStatus::kDeadline : SolveStatus::kIterationLimit);
      return x;
    };
    const auto near = [&] {
      return Points(body.mesh.points + random.points(body.mesh.numPoints(), 1e-4));
    };
    const auto make = [&] {
      return std::make_unique<Newton>(body.elasticity->makeMatrix(),
                                      std::make_unique<BlockPcg>(1000), true);
    };
    const auto goes_on = make(), anew = make();
    solve(goes_on.get(), 21, near(), nullptr);
    Points x = near();
    x(0, 40) += bent;
    int asked = 0;
    const Interrupt after_the_matrix = [&] { return ++asked == 2; };
    EXPECT_TRUE(solve(goes_on.get(), 30, x, &after_the_matrix) == x);
    EXPECT_EQ(asked, 2);
    StateWriter state;
    goes_on->save(&state);
    StateReader in(state.bytes());
    anew->restore(&in);
    x += random.points(x.cols(), 1e-4);
    const Points went_on = solve(goes_on.get(), 50, x, nullptr);
    EXPECT_TRUE(went_on == solve(anew.get(), 50, x, nullptr)) << bent;
  }
}

TEST(KeptStiffness, IsKeptOverWhatThePageSays) {
  std::ostringstream sentence;
  sentence << "more than " << 100.0 * KeptStiffness::kMostStrain << " % of its length, or "
           << 100.0 * KeptStiffness::kMostStrainInCycle << " % within a cycle";
  EXPECT_TRUE(
      test::contains(test::fileBytes(test::sourceFolder() + "/docs/theory.md"), sentence.str()))
      << sentence.str();
}

}  // namespace
}  // namespace palpate::solver::kept_stiffness_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/packed_tetrahedra.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fem/element_scatter.h"
#include "support/law_response.h"

namespace palpate::fem {
namespace {

// 5 x 4 x 3 cells, 360 tetrahedra, of which some are of a second, stiffer solid: no batch of
// either is a full one at its end.
class Packed : public ::testing::TestWithParam<bool> {  // with nodal pressures
 protected:
  Packed() {
    mesh = mesh::boxMesh(Vec3(0.05, 0.04, 0.03), Eigen::Vector3i(5, 4, 3));
    composition.solids = {
        {material::makeMaterial("neo_hookean", {{"mu", {2e3}}, {"kappa", {2e4}}}), 1000.0, {}},
        {material::makeMaterial("stable_neo_hookean", {{"mu", {5e4}}, {"kappa", {1e5}}}),
         1000.0,
         {}}};
    for (int e = 0; e < mesh.numTets(); ++e) composition.solid_of.push_back(e % 7 == 3);
    x = mesh.points;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      const Vec3 X = mesh.points.col(i);
      x.col(i) += 1e-3 * Vec3(std::sin(90 * X[1]), std::cos(70 * X[2]), std::sin(50 * X.sum()));
    }
    element_kappa = GetParam() ? std::vector<double>{1e3, 2.5e4} : std::vector<double>{2e4, 1e5};
  }

  struct Body {
    Body(const Packed& p, Isa isa, ThreadPool* pool)
        : shape(p.mesh, p.composition),
          scatter(shape.nodes, static_cast<int>(p.mesh.numPoints())),
          schedule(scheduleElements(p.mesh, p.composition)),
          history(p.composition, schedule.runs(), static_cast<int>(p.mesh.numTets()), 1, pool) {
      if (GetParam()) {
        pressure = std::make_unique<NodalPressure>(NodalPressure::Kind::kAveraged,
                                                   std::vector<double>{1.9e4, 7.5e4}, shape,
                                                   p.composition);
      }
      packed = std::make_unique<PackedTetrahedra>(schedule, shape, p.composition, p.element_kappa,
                                                  pressure.get(), &history, scatter.pattern(), pool,
                                                  isa);
      K = pressure ? Stiffness(scatter.pattern(), pressure->makeStiffness())
                   : Stiffness(scatter.pattern());
    }
    // A step from the rest shape to `at`, and the begin of the next one.
    void remember(const Points& at) {
      history.beginStep(0.01);
      packed->distortionalStresses(at, history.stressesAtEnd());
      history.endStep();
      history.beginStep(0.02);
      packed->forgetMemory();
    }
    void compute(const Points& at) {
      energy = packed->gradient(at, &g);
      packed->hessian(at, &K);
      K.multiply(g, &Kg);
    }

    RestShape<4> shape;
    ElementScatter<4> scatter;
    std::unique_ptr<NodalPressure> pressure;
    ElementSchedule schedule;
    PronyHistory history;
    std::unique_ptr<PackedTetrahedra> packed;
    Stiffness K;
    Points g, Kg;
    double energy = 0.0;
  };

  mesh::TetMesh mesh;
  Composition composition;
  std::vector<double> element_kappa;
  Points x;
};

TEST_P(Packed, GivesTheSameBitsWithAllInstructionsAndThreads) {
  Body first(*this, Isa::kBaseline, nullptr);
  first.compute(x);
  ASSERT_GT(first.energy, 0.0);
  for (const Isa isa : availableIsas()) {
    for (const int threads : {1, 2, 3}) {
      ThreadPool pool(threads);
      Body body(*this, isa, &pool);
      body.compute(x);
      EXPECT_EQ(body.energy, first.energy) << toString(isa) << ", " << threads << " threads";
      EXPECT_TRUE(body.g == first.g) << toString(isa) << ", " << threads << " threads";
      EXPECT_TRUE(body.Kg == first.Kg) << toString(isa) << ", " << threads << " threads";
    }
  }
}

TEST_P(Packed, ViscousSolidsGiveTheSameBitsWithAllInstructionsAndThreads) {
  composition.solids[0].prony = {{0.3, 0.1}, {0.2, 1.0}};
  Body first(*this, Isa::kBaseline, nullptr);
  first.compute(x);
  const double at_rest = first.energy;
  first.remember(0.99 * x);
  first.compute(x);
  EXPECT_NE(first.energy, at_rest);
  StateWriter memory;
  first.history.save(&memory);
  for (const Isa isa : availableIsas()) {
    for (const int threads : {1, 2, 3}) {
      ThreadPool pool(threads);
      Body body(*this, isa, &pool);
      body.remember(0.99 * x);
      body.compute(x);
      EXPECT_EQ(body.energy, first.energy) << toString(isa) << ", " << threads << " threads";
      EXPECT_TRUE(body.g == first.g) << toString(isa) << ", " << threads << " threads";
      EXPECT_TRUE(body.Kg == first.Kg) << toString(isa) << ", " << threads << " threads";
      EXPECT_EQ(body.packed->energy(x), first.packed->energy(x));
      StateWriter bytes;
      body.history.save(&bytes);
      EXPECT_EQ(bytes.bytes(), memory.bytes()) << toString(isa) << ", " << threads << " threads";
    }
  }
}

TEST_P(Packed, WhatIsKeptIsForgottenWithTheMemory) {
  composition.solids[0].prony = {{0.3, 0.1}};
  Body body(*this, bestIsa(), nullptr), fresh(*this, bestIsa(), nullptr);
  body.compute(x);
  body.remember(0.99 * x);
  fresh.remember(0.99 * x);
  EXPECT_EQ(body.packed->energy(x), fresh.packed->energy(x));
  body.compute(x);
  fresh.compute(x);
  EXPECT_EQ(body.energy, fresh.energy);
  EXPECT_TRUE(body.g == fresh.g);
  EXPECT_TRUE(body.Kg == fresh.Kg);
}

TEST_P(Packed, WhatIsKeptFromTheLastCallChangesNothing) {
  Body body(*this, bestIsa(), nullptr), fresh(*this, bestIsa(), nullptr);
  fresh.compute(x);
  const Points y = 1.01 * x;
  Points g;
  const double there = body.packed->energy(y);
  EXPECT_EQ(body.packed->energy(x), fresh.energy);
  EXPECT_EQ(body.packed->energy(x), fresh.energy);
  EXPECT_EQ(body.packed->gradient(y, &g), there);
  body.packed->hessian(x, &body.K);
  EXPECT_EQ(body.packed->gradient(x, &body.g), fresh.energy);
  body.K.multiply(body.g, &body.Kg);
  EXPECT_TRUE(body.g == fresh.g);
  EXPECT_TRUE(body.Kg == fresh.Kg);
  g.setZero();
  EXPECT_EQ(body.packed->gradient(x, &g), fresh.energy);
  EXPECT_TRUE(g == fresh.g);
}

// Without nodal pressures the energy is a plain sum over elements.
TEST_P(Packed, EnergyIsTheSumOfTheLaws) {
  if (GetParam()) return;
  Body body(*this, bestIsa(), nullptr);
  double sum = 0.0, smallest = std::numeric_limits<double>::infinity();
  for (int e = 0; e < mesh.numTets(); ++e) {
    Mat3 F = Mat3::Zero();
    const auto& point = body.shape.points[e][0];
    for (int a = 0; a < 4; ++a) {
      F += x.col(body.shape.nodes(a, e)) * point.gradients.col(a).transpose();
    }
    smallest = std::min(smallest, F.determinant());
    sum += point.volume * test::energyDensity(composition.solid(e).law, F);
  }
  EXPECT_NEAR(body.packed->energy(x), sum, 1e-12 * sum);
  EXPECT_NEAR(body.packed->minJacobian(x), smallest, 1e-13);
}

TEST_P(Packed, InvertedElementHasInfiniteEnergy) {
  Body body(*this, bestIsa(), nullptr);
  x.col(mesh.tets(0, 0)) += 3.0 * (x.col(mesh.tets(1, 0)) - x.col(mesh.tets(0, 0)));
  EXPECT_EQ(body.packed->energy(x), std::numeric_limits<double>::infinity());
  EXPECT_LT(body.packed->minJacobian(x), 0.0);
}

TEST_P(Packed, TakesViscousSolidsAndLeavesOtherLawsToOthers) {
  EXPECT_TRUE(PackedTetrahedra::fits(composition));
  composition.solids[0].prony = {{0.3, 1.0}};
  EXPECT_TRUE(PackedTetrahedra::fits(composition));
  composition.solids[1].law = material::makeMaterial("yeoh", material::exampleConstants("yeoh"));
  EXPECT_FALSE(PackedTetrahedra::fits(composition));
}

INSTANTIATE_TEST_SUITE_P(Pressures, Packed, ::testing::Bool(), [](const auto& test) {
  return test.param ? std::string("Nodal") : std::string("ByElement");
});

}  // namespace
}  // namespace palpate::fem

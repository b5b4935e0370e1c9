// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/packed_tetrahedra.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fem/element_scatter.h"
#include "support/law_response.h"
#include "support/random.h"

namespace palpate::fem::packed_tetrahedra_test {
namespace {

template <int N, bool kPressures>
struct Element {
  static constexpr int kNodes = N;
  static constexpr bool kNodalPressures = kPressures;
};

// 5 x 4 x 3 cells, 360 tetrahedra, of which some are of a second, stiffer solid: no batch of
// either is a full one at its end.
template <class Of>
class Packed : public ::testing::Test {
 protected:
  static constexpr int N = Of::kNodes;

  Packed() {
    mesh = mesh::boxMesh(Vec3(0.05, 0.04, 0.03), Eigen::Vector3i(5, 4, 3));
    if (N == 10) mesh = mesh::toQuadratic(mesh);
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
    element_kappa =
        Of::kNodalPressures ? std::vector<double>{1e3, 2.5e4} : std::vector<double>{2e4, 1e5};
  }

  struct Body {
    Body(const Packed& p, Isa isa, ThreadPool* pool)
        : shape(p.mesh, p.composition),
          scatter(shape.nodes, static_cast<int>(p.mesh.numPoints())),
          schedule(scheduleElements(p.mesh, p.composition)),
          history(p.composition, schedule.runs(), static_cast<int>(p.mesh.numTets()),
                  RestShape<N>::kPoints, pool) {
      if (Of::kNodalPressures) {
        pressure = std::make_unique<NodalPressure>(NodalPressure::Kind::kAveraged,
                                                   std::vector<double>{1.9e4, 7.5e4}, shape,
                                                   p.composition);
      }
      packed = std::make_unique<PackedTetrahedra<N>>(schedule, shape, p.composition,
                                                     p.element_kappa, pressure.get(), &history,
                                                     scatter.pattern(), pool, isa);
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

    RestShape<N> shape;
    ElementScatter<N> scatter;
    std::unique_ptr<NodalPressure> pressure;
    ElementSchedule schedule;
    PronyHistory history;
    std::unique_ptr<PackedTetrahedra<N>> packed;
    Stiffness K;
    Points g, Kg;
    double energy = 0.0;
  };

  mesh::TetMesh mesh;
  Composition composition;
  std::vector<double> element_kappa;
  Points x;
};

struct Name {
  template <class Of>
  static std::string GetName(int) {
    return (Of::kNodes == 4 ? "Linear" : "Quadratic") +
           std::string(Of::kNodalPressures ? "Nodal" : "ByElement");
  }
};
using Elements =
    ::testing::Types<Element<4, false>, Element<4, true>, Element<10, false>, Element<10, true>>;
TYPED_TEST_SUITE(Packed, Elements, Name);

TYPED_TEST(Packed, GivesTheSameBitsWithAllInstructionsAndThreads) {
  typename TestFixture::Body first(*this, Isa::kBaseline, nullptr);
  first.compute(this->x);
  ASSERT_GT(first.energy, 0.0);
  for (const Isa isa : availableIsas()) {
    for (const int threads : {1, 2, 3}) {
      ThreadPool pool(threads);
      typename TestFixture::Body body(*this, isa, &pool);
      body.compute(this->x);
      EXPECT_EQ(body.energy, first.energy) << toString(isa) << ", " << threads << " threads";
      EXPECT_TRUE(body.g == first.g) << toString(isa) << ", " << threads << " threads";
      EXPECT_TRUE(body.Kg == first.Kg) << toString(isa) << ", " << threads << " threads";
    }
  }
}

TYPED_TEST(Packed, ViscousSolidsGiveTheSameBitsWithAllInstructionsAndThreads) {
  this->composition.solids[0].prony = {{0.3, 0.1}, {0.2, 1.0}};
  typename TestFixture::Body first(*this, Isa::kBaseline, nullptr);
  first.compute(this->x);
  const double at_rest = first.energy;
  first.remember(0.99 * this->x);
  first.compute(this->x);
  EXPECT_NE(first.energy, at_rest);
  StateWriter memory;
  first.history.save(&memory);
  for (const Isa isa : availableIsas()) {
    for (const int threads : {1, 2, 3}) {
      ThreadPool pool(threads);
      typename TestFixture::Body body(*this, isa, &pool);
      body.remember(0.99 * this->x);
      body.compute(this->x);
      EXPECT_EQ(body.energy, first.energy) << toString(isa) << ", " << threads << " threads";
      EXPECT_TRUE(body.g == first.g) << toString(isa) << ", " << threads << " threads";
      EXPECT_TRUE(body.Kg == first.Kg) << toString(isa) << ", " << threads << " threads";
      EXPECT_EQ(body.packed->energy(this->x), first.packed->energy(this->x));
      StateWriter bytes;
      body.history.save(&bytes);
      EXPECT_EQ(bytes.bytes(), memory.bytes()) << toString(isa) << ", " << threads << " threads";
    }
  }
}

TYPED_TEST(Packed, WhatIsKeptIsForgottenWithTheMemory) {
  this->composition.solids[0].prony = {{0.3, 0.1}};
  typename TestFixture::Body body(*this, bestIsa(), nullptr), fresh(*this, bestIsa(), nullptr);
  body.compute(this->x);
  body.remember(0.99 * this->x);
  fresh.remember(0.99 * this->x);
  EXPECT_EQ(body.packed->energy(this->x), fresh.packed->energy(this->x));
  body.compute(this->x);
  fresh.compute(this->x);
  EXPECT_EQ(body.energy, fresh.energy);
  EXPECT_TRUE(body.g == fresh.g);
  EXPECT_TRUE(body.Kg == fresh.Kg);
}

TYPED_TEST(Packed, WhatIsKeptFromTheLastCallChangesNothing) {
  typename TestFixture::Body body(*this, bestIsa(), nullptr), fresh(*this, bestIsa(), nullptr);
  fresh.compute(this->x);
  const Points y = 1.01 * this->x;
  Points g;
  const double there = body.packed->energy(y);
  EXPECT_EQ(body.packed->energy(this->x), fresh.energy);
  EXPECT_EQ(body.packed->energy(this->x), fresh.energy);
  EXPECT_EQ(body.packed->gradient(y, &g), there);
  body.packed->hessian(this->x, &body.K);
  EXPECT_EQ(body.packed->gradient(this->x, &body.g), fresh.energy);
  body.K.multiply(body.g, &body.Kg);
  EXPECT_TRUE(body.g == fresh.g);
  EXPECT_TRUE(body.Kg == fresh.Kg);
  g.setZero();
  EXPECT_EQ(body.packed->gradient(this->x, &g), fresh.energy);
  EXPECT_TRUE(g == fresh.g);
}

// Without nodal pressures the energy is a plain sum over elements.
TYPED_TEST(Packed, EnergyIsTheSumOfTheLaws) {
  if (TypeParam::kNodalPressures) return;
  typename TestFixture::Body body(*this, bestIsa(), nullptr);
  double sum = 0.0, smallest = std::numeric_limits<double>::infinity();
  for (int e = 0; e < this->mesh.numTets(); ++e) {
    for (const auto& point : body.shape.points[e]) {
      Mat3 F = Mat3::Zero();
      for (int a = 0; a < TypeParam::kNodes; ++a) {
        F += this->x.col(body.shape.nodes(a, e)) * point.gradients.col(a).transpose();
      }
      smallest = std::min(smallest, F.determinant());
      sum += point.volume * test::energyDensity(this->composition.solid(e).law, F);
    }
  }
  EXPECT_NEAR(body.packed->energy(this->x), sum, 1e-12 * sum);
  EXPECT_NEAR(body.packed->minJacobian(this->x), smallest, 1e-13);
}

TYPED_TEST(Packed, GradientAndMatrixAreDerivatives) {
  this->composition.solids[0].prony = {{0.3, 0.1}};
  typename TestFixture::Body body(*this, bestIsa(), nullptr);
  body.remember(0.99 * this->x);
  test::Random random;
  const Points d = random.points(this->x.cols(), 1.0);
  body.compute(this->x);
  Points g = body.g, Kd, plus, minus;
  body.K.multiply(d, &Kd);
  constexpr double h = 1e-7;
  const double up = body.packed->gradient(this->x + h * d, &plus);
  const double down = body.packed->gradient(this->x - h * d, &minus);
  EXPECT_NEAR(g.cwiseProduct(d).sum(), (up - down) / (2 * h), 1e-6 * g.norm() * d.norm());
  EXPECT_LT((Kd - (plus - minus) / (2 * h)).norm(), 1e-6 * Kd.norm());
}

TYPED_TEST(Packed, NumbersOfNodesDoNotMatter) {
  typename TestFixture::Body body(*this, bestIsa(), nullptr);
  body.compute(this->x);
  // The other way round: nodes in the middle of edges come before corners.
  const Eigen::Index last = this->mesh.numPoints() - 1;
  const auto turn = [&](auto* nodes) { *nodes = (last - nodes->array()).matrix().eval(); };
  turn(&this->mesh.tets);
  if (this->mesh.quadratic()) turn(&this->mesh.midnodes);
  this->mesh.points = this->mesh.points.rowwise().reverse().eval();
  this->x = this->x.rowwise().reverse().eval();
  typename TestFixture::Body turned(*this, bestIsa(), nullptr);
  turned.compute(this->x);
  EXPECT_NEAR(turned.energy, body.energy, 1e-12 * body.energy);
  EXPECT_LT((turned.g.rowwise().reverse() - body.g).norm(), 1e-11 * body.g.norm());
  EXPECT_LT((turned.Kg.rowwise().reverse() - body.Kg).norm(), 1e-11 * body.Kg.norm());
}

TYPED_TEST(Packed, InvertedElementHasInfiniteEnergy) {
  typename TestFixture::Body body(*this, bestIsa(), nullptr);
  this->x.col(this->mesh.tets(0, 0)) +=
      3.0 * (this->x.col(this->mesh.tets(1, 0)) - this->x.col(this->mesh.tets(0, 0)));
  EXPECT_EQ(body.packed->energy(this->x), std::numeric_limits<double>::infinity());
  EXPECT_LT(body.packed->minJacobian(this->x), 0.0);
}

TYPED_TEST(Packed, TakesViscousSolidsAndLeavesOtherLawsToOthers) {
  EXPECT_TRUE(PackedTetrahedra<TypeParam::kNodes>::fits(this->mesh, this->composition));
  this->composition.solids[0].prony = {{0.3, 1.0}};
  EXPECT_TRUE(PackedTetrahedra<TypeParam::kNodes>::fits(this->mesh, this->composition));
  this->composition.solids[1].law =
      material::makeMaterial("yeoh", material::exampleConstants("yeoh"));
  EXPECT_FALSE(PackedTetrahedra<TypeParam::kNodes>::fits(this->mesh, this->composition));
}

}  // namespace
}  // namespace palpate::fem::packed_tetrahedra_test

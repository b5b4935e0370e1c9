// SPDX-License-Identifier: GPL-3.0-or-later
// Viscous solids by the kernels against the general path, which takes any law.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "palpate/fem/elasticity.h"
#include "support/random.h"

namespace palpate::fem::viscous_kernels_test {
namespace {

// Both laws with kernels, viscous in several terms, and a solid that is not viscous between them.
class ViscousKernels : public ::testing::TestWithParam<std::string> {
 protected:
  ViscousKernels() {
    composition.solids = {
        {law("neo_hookean", 2e3, 2e4), 1000.0, {{0.3, 0.02}, {0.2, 1.0}}},
        {law("stable_neo_hookean", 5e4, 1e5), 1000.0, {}},
        {law("stable_neo_hookean", 4e3, 2e4), 1000.0, {{0.2, 0.01}, {0.25, 0.1}, {0.1, 5.0}}}};
    for (int e = 0; e < mesh.numTets(); ++e) {
      composition.solid_of.push_back(e % 7 == 3                               ? 1
                                     : mesh.points(0, mesh.tets(0, e)) < 0.02 ? 0
                                                                              : 2);
    }
    // One solid of another law, though no element is of it, and the body goes the general way.
    Composition any = composition;
    any.solids.push_back(
        {material::makeMaterial("yeoh", material::exampleConstants("yeoh")), 1000.0, {}});
    packed = makeElasticity(GetParam(), mesh, composition);
    general = makeElasticity(GetParam(), mesh, any);
  }

  static material::Material law(const std::string& name, double mu, double kappa) {
    return material::makeMaterial(name, {{"mu", {mu}}, {"kappa", {kappa}}});
  }
  Points moved(double by) { return mesh.points + random.points(mesh.numPoints(), by); }
  // What both give at x, up to rounding.
  void compare(const Points& x) {
    Points g, expected_g, Kd, expected_Kd;
    const double scale = general->gradient(x, &expected_g);
    EXPECT_NEAR(packed->gradient(x, &g), scale, 1e-12 * std::abs(scale));
    EXPECT_NEAR(packed->energy(x), scale, 1e-12 * std::abs(scale));
    EXPECT_LT((g - expected_g).norm(), 1e-12 * expected_g.norm());
    Stiffness K = packed->makeMatrix(), expected_K = general->makeMatrix();
    packed->hessian(x, Tangent::kExact, &K);
    general->hessian(x, Tangent::kExact, &expected_K);
    for (int trial = 0; trial < 3; ++trial) {
      const Points d = random.points(mesh.numPoints(), 1.0);
      K.multiply(d, &Kd);
      expected_K.multiply(d, &expected_Kd);
      EXPECT_LT((Kd - expected_Kd).norm(), 1e-12 * expected_Kd.norm());
    }
  }
  void forBoth(const std::function<void(Elasticity*)>& work) {
    work(packed.get());
    work(general.get());
  }

  TetMesh mesh =
      meshFor(GetParam(), mesh::boxMesh(Vec3(0.05, 0.04, 0.03), Eigen::Vector3i(5, 4, 3)));
  Composition composition;
  std::unique_ptr<Elasticity> packed, general;
  test::Random random;
};

TEST_P(ViscousKernels, GiveWhatTheGeneralPathGives) {
  ASSERT_TRUE(packed->viscous());
  compare(moved(1e-3));  // at rest for ever
  for (const double h : {0.01, 0.003, 0.2}) {
    const Points end = moved(1e-3);
    forBoth([&](Elasticity* body) { body->beginStep(h); });
    compare(moved(1e-3));
    forBoth([&](Elasticity* body) { body->endStep(end); });
    compare(moved(1e-3));  // still with what the step began with
  }
  const Points held = moved(1e-3), x = moved(1e-3);
  forBoth([&](Elasticity* body) {
    body->relax(held);
    body->beginStep(0.05);
  });
  compare(x);
  forBoth([&](Elasticity* body) { body->beginStep(std::numeric_limits<double>::infinity()); });
  compare(x);
}

// States and energies by solid of a packed body are computed point by point, from its memory.
TEST_P(ViscousKernels, LeaveTheirMemoryToAllOthers) {
  const Points end = moved(1e-3), x = moved(1e-3);
  forBoth([&](Elasticity* body) {
    body->beginStep(0.01);
    body->endStep(end);
    body->beginStep(0.02);
  });
  EXPECT_NEAR(packed->energyBySolid(x).sum(), packed->energy(x), 1e-12 * packed->energy(x));
  std::vector<mesh::Location> places;
  for (int e = 0; e < mesh.numTets(); e += 11)
    places.push_back({e, Eigen::Vector4d::Constant(0.25)});
  const auto states = packed->states(x, places), expected = general->states(x, places);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Mat3& sigma = expected[k].cauchy_stress;
    EXPECT_LT((states[k].cauchy_stress - sigma).norm(), 1e-12 * sigma.norm());
  }
}

TEST_P(ViscousKernels, AreTheDerivativesOfTheEnergy) {
  const Points end = moved(1e-3), x = moved(1e-3);
  packed->beginStep(0.02);
  packed->endStep(end);
  packed->beginStep(0.01);
  Points g, plus, minus, Kd;
  packed->gradient(x, &g);
  Stiffness K = packed->makeMatrix();
  packed->hessian(x, Tangent::kExact, &K);
  for (int trial = 0; trial < 5; ++trial) {
    const Points d = random.points(mesh.numPoints(), 1.0);
    constexpr double h = 1e-7;
    const double slope = (packed->energy(x + h * d) - packed->energy(x - h * d)) / (2.0 * h);
    EXPECT_NEAR(g.cwiseProduct(d).sum(), slope, 1e-6 * g.norm() * d.norm());
    K.multiply(d, &Kd);
    packed->gradient(x + h * d, &plus);
    packed->gradient(x - h * d, &minus);
    EXPECT_LT((Kd - (plus - minus) / (2.0 * h)).norm(), 1e-6 * Kd.norm());
  }
}

// Flat and turned inside out, S would be of any size and sign: the next step's energy would fall
// without bound as the body grows.
TEST_P(ViscousKernels, RememberNoStressOfWhatIsInsideOut) {
  for (const double flat : {1e-6, -1e-6, -0.01, -0.5}) {
    Points inside_out = mesh.points;
    inside_out.row(2) *= flat;
    forBoth([&](Elasticity* body) {
      body->beginStep(0.01);
      body->endStep(inside_out);
      body->beginStep(0.01);
    });
    compare(moved(1e-3));
    double before = packed->energy(mesh.points);
    for (const double grown : {2.0, 10.0, 100.0}) {
      const double energy = packed->energy(grown * mesh.points);
      EXPECT_GT(energy, before) << flat << ", by " << grown;
      before = energy;
    }
  }
}

TEST_P(ViscousKernels, MemoryIsGivenBack) {
  const Points end = moved(1e-3), other = moved(1e-3), x = moved(1e-3);
  packed->beginStep(0.02);
  packed->endStep(end);
  packed->beginStep(0.01);
  const double energy = packed->energy(x);
  const auto saved = packed->saveViscousState();
  for (int trial = 0; trial < 2; ++trial) {
    for (int k = 0; k < 3; ++k) {
      packed->endStep(other);
      packed->beginStep(0.01);
    }
    EXPECT_NE(packed->energy(x), energy);
    packed->restoreViscousState(saved.get());
    EXPECT_EQ(packed->energy(x), energy);
  }
  StateWriter out;
  packed->save(&out);
  packed->endStep(other);
  packed->beginStep(0.03);
  EXPECT_NE(packed->energy(x), energy);
  StateReader in(out.bytes());
  packed->restore(&in);
  EXPECT_EQ(packed->energy(x), energy);
  const auto fresh = makeElasticity(GetParam(), mesh, composition);
  StateReader again(out.bytes());
  fresh->restore(&again);
  EXPECT_EQ(fresh->energy(x), energy);
}

INSTANTIATE_TEST_SUITE_P(Elements, ViscousKernels, ::testing::ValuesIn(elementNames()),
                         [](const auto& element) { return element.param; });

}  // namespace
}  // namespace palpate::fem::viscous_kernels_test

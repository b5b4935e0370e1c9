// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "slab.h"

namespace palpate::tissue::outside_of_law_test {
namespace {

using test::kStep;
using test::Slab;

// A law that has no energy inside out: no step of any method leads away from there.
TEST(OutsideOfItsLaw, AnOrganBeginsAnew) {
  for (const char* method : {"implicit_pcg", "implicit_direct", "lbfgs", "tled"}) {
    Slab slab(Eigen::Vector3i(4, 4, 2));
    slab.settings.method = method;
    slab.settings.gravity.setZero();
    const material::Material law = material::makeMaterial(
        "neo_hookean", {{"young_modulus", {6e3}}, {"poisson_ratio", {0.45}}});
    const auto tissue = makeFemTissue(slab.mesh, fem::Composition::uniform(law, 1060.0), slab.free,
                                      slab.settings, nullptr);
    const Points rest = tissue->positions();
    Points inside_out = rest;
    inside_out.row(2) *= -1.0;
    tissue->setPositions(0, inside_out, Points::Zero(3, rest.cols()));
    const TissueStep& first = tissue->step({}, kStep);
    EXPECT_EQ(first.status, solver::SolveStatus::kInverted) << method;
    EXPECT_TRUE(std::isfinite(first.elastic_energy)) << method;
    EXPECT_TRUE(std::isfinite(first.residual)) << method;
    EXPECT_TRUE(tissue->step({}, kStep).ok()) << method;
    EXPECT_LT((tissue->positions() - rest).cwiseAbs().maxCoeff(), 1e-9) << method;
  }
}

// An exponential law has an energy as long as there is a number for it, but here its forces have no
// norm.
TEST(OutsideOfItsLaw, AnOrganBeginsAnewWhereForcesCannotBeReckonedWith) {
  const material::Material law =
      material::makeMaterial("demiray", {{"a", {3e3}}, {"b", {1.5}}, {"poisson_ratio", {0.45}}});
  for (const char* method : {"implicit_pcg", "implicit_direct", "lbfgs", "tled"}) {
    Slab slab(Eigen::Vector3i(4, 4, 2));
    slab.settings.method = method;
    slab.settings.gravity.setZero();
    const auto tissue = makeFemTissue(slab.mesh, fem::Composition::uniform(law, 1060.0), slab.free,
                                      slab.settings, nullptr);
    const Points rest = tissue->positions();
    Points stretched = rest;
    // W = a / 2b (exp(b (I1 - 3)) - 1), where the isochoric I1 is about the stretch's 4/3rd power.
    stretched.row(0) *= std::pow(3.0 + std::log(1e250) / 1.5, 0.75);
    tissue->setPositions(0, stretched, Points::Zero(3, rest.cols()));
    const TissueStep& first = tissue->step({}, kStep);
    EXPECT_EQ(first.status, solver::SolveStatus::kInverted) << method;
    EXPECT_EQ(first.recovery, static_cast<int>(Recovery::kPutBack)) << method;
    EXPECT_TRUE(std::isfinite(first.elastic_energy)) << method;
    EXPECT_TRUE(std::isfinite(first.residual)) << method;
    EXPECT_TRUE(tissue->step({}, kStep).ok()) << method;
    EXPECT_LT((tissue->positions() - rest).cwiseAbs().maxCoeff(), 1e-9) << method;
  }
}

// An organ that is carried 25 mm, as wide as an element: it goes on from there, not by a leap.
TEST(OutsideOfItsLaw, AnOrganBeginsAnewWhereItIsCarriedTo) {
  const material::Material law =
      material::makeMaterial("neo_hookean", {{"young_modulus", {6e3}}, {"poisson_ratio", {0.45}}});
  Wave wave;
  wave.amplitude = Vec3(0.025, 0.0, 0.0);
  for (const char* method : {"implicit_pcg", "implicit_direct", "lbfgs", "tled"}) {
    for (const bool springs : {false, true}) {
      Slab slab(Eigen::Vector3i(4, 4, 2));
      slab.settings.method = method;
      slab.settings.gravity.setZero();
      slab.settings.mass_damping = 20.0;
      Surroundings surroundings(slab.free);
      std::vector<int> bottom;
      for (int i = 0; i < slab.mesh.numPoints(); ++i) {
        if (slab.free(2, i) == 0.0) bottom.push_back(i);
      }
      if (springs) {
        surroundings.free.setOnes();
        surroundings.springs.push_back({bottom, {1e7, 1e7, 0.0}, Motion(wave)});
      } else {
        surroundings.carried.push_back({bottom, Motion(wave)});
      }
      const auto make = [&] {
        return makeFemTissue(slab.mesh, fem::Composition::uniform(law, 1060.0), surroundings,
                             slab.settings, nullptr);
      };
      const auto tissue = make(), alike = make();
      for (int k = 0; k < 124; ++k) {  // to the second crest
        tissue->step({}, kStep);
        alike->step({}, kStep);
      }
      Points inside_out = tissue->positions();
      inside_out.row(2) *= -1.0;
      tissue->setPositions(0, inside_out, Points::Zero(3, inside_out.cols()));
      const TissueStep& put = tissue->step({}, kStep);
      EXPECT_EQ(put.recovery, static_cast<int>(Recovery::kPutBack)) << method;
      alike->step({}, kStep);
      // The braking of the crest, 1 m/s^2, and the way in a cycle without it.
      const double off = (tissue->positions() - alike->positions()).colwise().norm().maxCoeff();
      EXPECT_LT(off, 1e-3) << method << springs;
      for (int k = 0; k < 20; ++k) {
        const TissueStep& step = tissue->step({}, kStep);
        EXPECT_TRUE(step.ok()) << method << springs << ", " << k;
        EXPECT_GT(step.min_jacobian, 0.9) << method << springs << ", " << k;
      }
    }
  }
}

// Of which a part is held and another one carried, as far as half an element, there is no such
// place: it goes on from where it was at rest first, in as many cycles as it takes.
TEST(OutsideOfItsLaw, AnOrganBeginsAnewThatIsHeldAndCarried) {
  const material::Material law =
      material::makeMaterial("neo_hookean", {{"young_modulus", {6e3}}, {"poisson_ratio", {0.45}}});
  Wave wave;
  wave.amplitude = Vec3(0.0, 0.0, 0.0125);
  for (const char* method : {"implicit_pcg", "implicit_direct", "lbfgs"}) {
    Slab slab(Eigen::Vector3i(4, 4, 2));
    slab.settings.method = method;
    slab.settings.gravity.setZero();
    slab.settings.mass_damping = 20.0;
    Surroundings surroundings(slab.free);
    std::vector<int> top;
    for (int i = 0; i < slab.mesh.numPoints(); ++i) {
      if (slab.mesh.points(2, i) > slab.mesh.points.row(2).maxCoeff() - 1e-9) top.push_back(i);
    }
    for (const int i : top) surroundings.free.col(i).setZero();
    surroundings.carried.push_back({top, Motion(wave)});
    const auto tissue = makeFemTissue(slab.mesh, fem::Composition::uniform(law, 1060.0),
                                      surroundings, slab.settings, nullptr);
    for (int k = 0; k < 124; ++k) tissue->step({}, kStep);
    Points inside_out = tissue->positions();
    inside_out.row(2) *= -1.0;
    tissue->setPositions(0, inside_out, Points::Zero(3, inside_out.cols()));
    EXPECT_EQ(tissue->step({}, kStep).recovery, static_cast<int>(Recovery::kPutBack)) << method;
    for (int k = 0; k < 50; ++k) tissue->step({}, kStep);
    for (int k = 0; k < 50; ++k) {
      const TissueStep& step = tissue->step({}, kStep);
      EXPECT_TRUE(step.ok()) << method << ", " << k;
      EXPECT_GT(step.min_jacobian, 0.3) << method << ", " << k;
    }
  }
}

}  // namespace
}  // namespace palpate::tissue::outside_of_law_test

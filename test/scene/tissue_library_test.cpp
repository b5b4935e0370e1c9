// SPDX-License-Identifier: GPL-3.0-or-later
// The tissues that are shipped.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "palpate/scene/tissue_file.h"
#include "support/law_response.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"
#include "support/uniaxial.h"

namespace palpate::scene::tissue_library_test {
namespace {

const std::string kFolder = test::sourceFolder() + "/config/materials/";

material::Solid solidOf(const std::string& tissue) {
  MaterialConfig material;
  material.file = kFolder + tissue + ".yaml";
  return makeSolid(material, "", "");
}

// As the sources print them, before any conversion: [Pa].
const std::map<std::string, double> kShearModuli = {
    {"adventitia", 7.64e3},
    {"brain_basal_ganglia", 0.70e3},
    {"brain_corona_radiata", 0.66e3},
    {"brain_corpus_callosum", 0.35e3},
    {"brain_cortex", 1.43e3},
    {"brain_surgical", 842.0},
    {"dermis", 40.0e3 / 2.9},
    {"epidermis", 4.0e6 / 2.9},
    {"gallbladder", 4.0e3 / 2.9},
    {"hepatic_vein", 0.62e6 / 2.9},
    {"hypodermis", 15.0e3 / 2.9},
    {"kidney_cortex", 5.0e3 / 2.9},
    {"liver", 2.0e3},
    {"liver_capsule", 8.22e6 / 2.9},
    {"muscle", 3.91e3},
    {"myocardium", 134.8},
    {"pancreas", 4.8e3 / 2.9},
    {"phantom", 1.0e4 / 2.9},
    {"skin", 1.18e6 / 2.9},
    {"skin_cat", 3.94e3 * 5.03},
    {"spleen", 2.9e3 / 2.9},
    {"subcutaneous_fat", 1.6e3 / 3.0},
};

TEST(TissueLibrary, EveryTissueIsReadAndHasItsSourcesShearModulus) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    SCOPED_TRACE(entry.path());
    const std::string name = entry.path().stem().string();
    ASSERT_TRUE(kShearModuli.count(name));
    ASSERT_NO_THROW(readTissueFile(entry.path().string()));
    const material::Solid solid = solidOf(name);
    EXPECT_NEAR(material::moduli(solid.law).mu, kShearModuli.at(name),
                1e-3 * kShearModuli.at(name));
    EXPECT_GT(material::moduli(solid.law).kappa, 9.0 * material::moduli(solid.law).mu);
    EXPECT_GT(solid.density, 900.0);
    EXPECT_LT(solid.density, 1100.0);
    ++count;
  }
  EXPECT_EQ(count, kShearModuli.size());
}

TEST(TissueLibrary, FatHasTheSlopesOfItsSource) {
  const material::Material fat = solidOf("subcutaneous_fat").law;
  const auto slope = [&](double strain) {
    constexpr double h = 1e-4;
    double ignored = 0.0;
    return (test::uniaxialStress(fat, 1.0 + strain + h, &ignored) -
            test::uniaxialStress(fat, 1.0 + strain - h, &ignored)) /
           (2.0 * h);
  };
  EXPECT_NEAR(slope(0.0), 1.6e3, 0.02 * 1.6e3);
  EXPECT_NEAR(slope(0.3), 11.7e3, 0.05 * 11.7e3);
}

TEST(TissueLibrary, BrainIsStifferInCompression) {
  for (const char* name : {"brain_cortex", "brain_basal_ganglia", "brain_corona_radiata",
                           "brain_corpus_callosum", "brain_surgical"}) {
    const material::Material law = solidOf(name).law;
    double ignored = 0.0;
    EXPECT_GT(-test::uniaxialStress(law, 0.9, &ignored),
              1.2 * test::uniaxialStress(law, 1.1, &ignored))
        << name;
  }
}

// What is left of the shear modulus after long, as the sources print it.
const std::map<std::string, double> kLeft = {
    {"brain_surgical", 0.185}, {"dermis", 0.47},        {"gallbladder", 0.91 / 2.04},
    {"liver", 0.91 / 2.04},    {"muscle", 1.0 - 0.549}, {"kidney_cortex", 0.91 / 2.04},
};

TEST(TissueLibrary, TissuesRelaxAsMuchAsTheirSourcesSayInTheTimesOfAHand) {
  for (const auto& [tissue, modulus] : kShearModuli) {
    SCOPED_TRACE(tissue);
    const std::vector<material::PronyTerm> prony = solidOf(tissue).prony;
    double left = 1.0;
    for (const material::PronyTerm& term : prony) {
      left -= term.g;
      EXPECT_GT(term.tau, 0.01);
      EXPECT_LT(term.tau, 100.0);
    }
    EXPECT_NEAR(left, kLeft.count(tissue) ? kLeft.at(tissue) : 1.0, 0.005);
  }
}

// Law of the organs that tools are pressed into hard.
TEST(TissueLibrary, SoftOrgansDoNotTurnInsideOut) {
  for (const char* name :
       {"gallbladder", "kidney_cortex", "liver", "muscle", "pancreas", "phantom", "spleen"}) {
    const material::Material law = solidOf(name).law;
    const double mu = material::moduli(law).mu;
    double last = 0.0;
    for (const double squeeze : {0.1, 0.01, 0.001}) {
      const Mat3 F = Eigen::Vector3d(1.0, 1.0, squeeze).asDiagonal();
      const double energy = test::energyDensity(law, F);
      EXPECT_GT(energy, last + mu) << name;
      last = energy;
    }
    const Mat3 inverted = Eigen::Vector3d(1.0, 1.0, -0.1).asDiagonal();
    EXPECT_TRUE(std::isinf(test::energyDensity(law, inverted))) << name;
  }
}

TEST(TissuePage, CommittedPageIsTheGeneratedOne) {
  EXPECT_EQ(test::fileBytes(test::sourceFolder() + "/docs/tissues.md"), tissuesMarkdown(kFolder))
      << "regenerate: palpate docs tissues > docs/tissues.md";
}

}  // namespace
}  // namespace palpate::scene::tissue_library_test

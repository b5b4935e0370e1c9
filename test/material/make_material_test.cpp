// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "palpate/material/material.h"
#include "support/contains.h"

namespace palpate::material::make_material_test {
namespace {

using test::contains;

std::string refusal(const std::string& law, const Constants& constants) {
  try {
    makeMaterial(law, constants);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

const Constants kGood{{"young_modulus", {5e3}}, {"poisson_ratio", {0.45}}};

TEST(MakeMaterial, MakesEveryLawInTheList) {
  for (const std::string& name : materialNames()) {
    EXPECT_NO_THROW(makeMaterial(name, exampleConstants(name))) << name;
    EXPECT_FALSE(constantNames(name).empty()) << name;
  }
}

TEST(MakeMaterial, TakesEitherPairOfModuli) {
  const Moduli young = moduli(makeMaterial("neo_hookean", kGood));
  const Moduli direct =
      moduli(makeMaterial("neo_hookean", {{"mu", {young.mu}}, {"kappa", {young.kappa}}}));
  EXPECT_DOUBLE_EQ(direct.mu, 5e3 / 2.9);
  EXPECT_DOUBLE_EQ(direct.kappa, young.kappa);
}

TEST(MakeMaterial, NamesTheNearestLaw) {
  const std::string text = refusal("neo_hokean", kGood);
  EXPECT_TRUE(contains(text, "neo_hokean"));
  EXPECT_TRUE(contains(text, "did you mean neo_hookean?"));
  EXPECT_TRUE(contains(text, "st_venant_kirchhoff"));
}

TEST(MakeMaterial, NamesTheNearestConstant) {
  EXPECT_TRUE(
      contains(refusal("neo_hookean", {{"young_modulos", {5e3}}, {"poisson_ratio", {0.45}}}),
               "did you mean young_modulus?"));
}

TEST(MakeMaterial, RefusesConstantsOutOfRange) {
  for (const double nu : {0.5, 0.6, -1.0, std::nan("")}) {
    EXPECT_TRUE(
        contains(refusal("neo_hookean", {{"young_modulus", {5e3}}, {"poisson_ratio", {nu}}}),
                 "must be one number in (-1, 0.5)"));
  }
  for (const double E : {0.0, -1.0, std::nan(""), double{INFINITY}}) {
    EXPECT_TRUE(contains(refusal("neo_hookean", {{"young_modulus", {E}}, {"poisson_ratio", {0.3}}}),
                         "must be one number > 0"));
  }
  EXPECT_TRUE(contains(refusal("neo_hookean", {{"mu", {1.0, 2.0}}, {"kappa", {1.0}}}), "1, 2"));
}

TEST(MakeMaterial, RefusesHalfOrMixedPairs) {
  for (const Constants& constants :
       {Constants{}, Constants{{"mu", {1.0}}}, Constants{{"mu", {1.0}}, {"poisson_ratio", {0.3}}},
        Constants{{"mu", {1.0}}, {"kappa", {1.0}}, {"young_modulus", {1.0}}}}) {
    EXPECT_TRUE(contains(refusal("neo_hookean", constants), "needs either"));
  }
}

}  // namespace
}  // namespace palpate::material::make_material_test

// SPDX-License-Identifier: GPL-3.0-or-later
// The law of docs/adding_a_law.md, listed as that page says. The typed property tests that are
// built with this file run on it, too.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "palpate/material/law_list.h"

namespace palpate::material {
namespace {

TEST(AddedLaw, IsKnownByItsName) {
  const std::vector<std::string> names = materialNames();
  EXPECT_EQ(std::count(names.begin(), names.end(), "gent"), 1);
  EXPECT_EQ(constantNames("gent"),
            (std::vector<std::string>{"mu", "jm", "kappa", "poisson_ratio"}));
  EXPECT_FALSE(needsFibres(makeMaterial("gent", exampleConstants("gent"))));
}

// Without the change of volume, a sheared Gent solid has P12 = mu g / (1 - g^2/jm).
TEST(AddedLaw, IsGents) {
  const Material law = makeMaterial("gent", {{"mu", {300.0}}, {"jm", {2.0}}, {"kappa", {1e3}}});
  ASSERT_NE(lawIf<Gent>(law), nullptr);
  Mat3 F = Mat3::Identity();
  F(0, 1) = 0.8;
  EXPECT_NEAR(firstPiolaKirchhoff(*lawIf<Gent>(law), F)(0, 1), 300.0 * 0.8 / (1.0 - 0.32), 1e-9);
  F(0, 1) = 1.5;
  EXPECT_TRUE(std::isinf(energyDensity(*lawIf<Gent>(law), F)));
}

}  // namespace
}  // namespace palpate::material

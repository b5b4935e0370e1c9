// SPDX-License-Identifier: GPL-3.0-or-later
// Constants of which no body can be made, and what the user is told.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "palpate/material/material.h"
#include "palpate/material/solid.h"
#include "support/contains.h"

namespace palpate::material::refusals_test {
namespace {

struct Refusal {
  std::string law;
  std::string constant;  // of the law's example(), replaced by
  std::vector<double> value;
  std::string text;  // which the error contains
};

std::string refusalOf(const std::string& law, const Constants& constants) {
  try {
    makeMaterial(law, constants);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

const double kNan = std::nan(""), kInf = INFINITY;

const std::vector<Refusal> kRefusals{
    {"linear", "mu", {0.0}, "mu = 0: must be one number > 0"},
    {"corotational", "kappa", {-1.0}, "kappa = -1: must be one number > 0"},
    {"mooney_rivlin", "c01", {-600.0}, "c10 + c01 = 0: must be > 0"},
    {"mooney_rivlin", "c10", {kNan}, "c10 = nan: must be one number, finite"},
    {"mooney_rivlin", "kappa", {0.0}, "kappa = 0: must be one number > 0"},
    {"mooney_rivlin", "kappa", {kInf}, "kappa = inf: must be one number > 0, finite"},
    {"yeoh", "c1", {0.0}, "c1 = 0: must be one number > 0"},
    {"yeoh", "c2", {-kInf}, "c2 = -inf: must be one number, finite"},
    {"yeoh", "c3", {1.0, 2.0}, "c3 = 1, 2: must be one number, finite"},
    {"yeoh", "c3", {}, "c3 = : must be one number, finite"},
    {"veronda_westmann", "c1", {-1.0}, "c1 = -1: must be one number > 0"},
    {"veronda_westmann", "alpha", {0.0}, "alpha = 0: must be one number > 0"},
    {"veronda_westmann", "c2", {-1200.0}, "c1 alpha + c2 = 0: must be > 0"},
    {"demiray", "a", {-5.0}, "a = -5: must be one number > 0"},
    {"demiray", "b", {0.0}, "b = 0: must be one number > 0"},
    {"ogden", "mu", {1500.0}, "alpha = 2.2, -3.1: must be as many numbers as mu has, 1"},
    {"ogden", "mu", {}, "mu = : must be one number or more"},
    {"ogden", "mu", {1500.0, 400.0}, "mu[1] alpha[1] = -1240: must be > 0"},
    {"ogden", "alpha", {0.0, -3.1}, "mu[0] alpha[0] = 0: must be > 0"},
    {"ogden", "alpha", {2.2, kNan}, "alpha = 2.2, nan: must be one number or more, finite"},
    {"holzapfel_gasser_ogden", "mu", {0.0}, "mu = 0: must be one number > 0"},
    {"holzapfel_gasser_ogden", "k1", {1.0, -2.0}, "k1 = -2: must be >= 0"},
    {"holzapfel_gasser_ogden", "k2", {0.0, 1.0}, "k2 = 0: must be > 0"},
    {"holzapfel_gasser_ogden", "dispersion", {0.0, 0.34}, "dispersion = 0.34: must be in [0, 1/3]"},
    {"holzapfel_gasser_ogden", "dispersion", {-0.1, 0.0}, "dispersion = -0.1: must be in [0, 1/3]"},
    {"holzapfel_gasser_ogden", "angle", {1.0}, "angle = 1: must be as many numbers as k1 has, 2"},
    {"holzapfel_gasser_ogden", "angle", {1.0, kInf}, "angle = 1, inf: must be one number or more"},
    {"guccione", "c", {0.0}, "c = 0: must be one number > 0"},
    {"guccione", "bf", {-1.0}, "bf = -1: must be one number > 0"},
    {"guccione", "bt", {0.0}, "bt = 0: must be one number > 0"},
    {"guccione", "bfs", {kNan}, "bfs = nan: must be one number > 0"},
    {"holzapfel_ogden", "a", {0.0}, "a = 0: must be one number > 0"},
    {"holzapfel_ogden", "b", {0.0}, "b = 0: must be one number > 0"},
    {"holzapfel_ogden", "af", {-1.0}, "af = -1: must be one number >= 0"},
    {"holzapfel_ogden", "as", {-1.0}, "as = -1: must be one number >= 0"},
    {"holzapfel_ogden", "afs", {-1.0}, "afs = -1: must be one number >= 0"},
    {"holzapfel_ogden", "bf", {0.0}, "bf = 0: must be one number > 0"},
    {"holzapfel_ogden", "bs", {-2.0}, "bs = -2: must be one number > 0"},
    {"holzapfel_ogden", "bfs", {kInf}, "bfs = inf: must be one number > 0"},
};

TEST(Refusals, NameConstantValueAndRange) {
  for (const Refusal& r : kRefusals) {
    Constants constants = exampleConstants(r.law);
    constants[r.constant] = r.value;
    EXPECT_TRUE(test::contains(refusalOf(r.law, constants), r.text)) << r.law;
  }
}

TEST(Refusals, AreDataAsWell) {
  for (const Refusal& r : kRefusals) {
    Constants constants = exampleConstants(r.law);
    constants[r.constant] = r.value;
    try {
      makeMaterial(r.law, constants);
      FAIL() << r.law;
    } catch (const ConstantError& error) {
      EXPECT_EQ(error.name + " = " + error.value + ": " + error.allowed, error.what());
      EXPECT_EQ(r.text.find(error.name + " = " + error.value + ": must be"), 0u) << r.text;
      EXPECT_EQ(error.allowed.find("must be "), 0u) << error.allowed;
    }
  }
}

PronyError refusalOf(const std::string& law, const std::vector<PronyTerm>& prony) {
  try {
    checkProny(makeMaterial(law, exampleConstants(law)), prony);
  } catch (const PronyError& error) {
    return error;
  }
  return {"accepted", "", ""};
}

TEST(Refusals, OfAPronySeriesNameTheTermToBlame) {
  const PronyError g = refusalOf("ogden", {{0.2, 1.0}, {1.5, 1.0}});
  EXPECT_STREQ(g.what(), "g = 1.5: must be in (0, 1)");
  EXPECT_EQ(g.name, "g");
  EXPECT_EQ(g.value, "1.5");
  EXPECT_EQ(g.term, 1u);
  const PronyError tau = refusalOf("ogden", {{0.2, 0.0}});
  EXPECT_EQ(tau.name, "tau");
  EXPECT_EQ(tau.term, 0u);
  const PronyError sum = refusalOf("ogden", {{0.5, 1.0}, {0.5, 2.0}});
  EXPECT_STREQ(sum.what(), "sum of g = 1: must be < 1, or nothing is left after long");
  EXPECT_FALSE(sum.term);
  const PronyError law = refusalOf("linear", {{0.5, 1.0}});
  EXPECT_STREQ(law.what(), "law linear is for small rotations and cannot relax; use corotational");
  EXPECT_EQ(law.name, "law");
  EXPECT_FALSE(law.term);
}

// A law knows its own constants and no others, and needs them all but the optional ones.
TEST(Refusals, EveryConstantOfEveryExampleIsNeeded) {
  for (const std::string& law : materialNames()) {
    for (const auto& [name, value] : exampleConstants(law)) {
      Constants constants = exampleConstants(law);
      constants.erase(name);
      EXPECT_TRUE(test::contains(refusalOf(law, constants), "needs ")) << law << ": " << name;
    }
  }
}

TEST(Refusals, EveryNumberMustBeFinite) {
  for (const std::string& law : materialNames()) {
    for (const auto& [name, value] : exampleConstants(law)) {
      for (const double wrong : {kNan, kInf, -kInf}) {
        Constants constants = exampleConstants(law);
        constants[name].back() = wrong;
        EXPECT_TRUE(test::contains(refusalOf(law, constants), name + " = ")) << law;
      }
    }
  }
}

TEST(Refusals, KappaOrPoissonRatioNotBoth) {
  for (const std::string& law : materialNames()) {
    Constants constants = exampleConstants(law);
    constants["poisson_ratio"] = {0.4};
    EXPECT_TRUE(test::contains(refusalOf(law, constants), "needs ")) << law;
  }
}

TEST(Refusals, PoissonRatioInPlaceOfKappa) {
  for (const std::string& law : materialNames()) {
    Constants constants = exampleConstants(law);
    if (constants.count("mu") && constants.size() == 2) continue;  // has Young's modulus for that
    constants.erase("kappa");
    for (const double wrong : {0.5, -1.0, kNan}) {
      constants["poisson_ratio"] = {wrong};
      EXPECT_TRUE(test::contains(refusalOf(law, constants), "must be one number in (-1, 0.5)"))
          << law;
    }
    constants["poisson_ratio"] = {0.45};
    EXPECT_EQ(refusalOf(law, constants), "accepted") << law;
  }
}

}  // namespace
}  // namespace palpate::material::refusals_test

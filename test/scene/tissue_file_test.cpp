// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/scene/tissue_file.h"

#include <gtest/gtest.h>

#include "support/input_error.h"
#include "support/temp_folder.h"

namespace palpate::scene::tissue_file_test {
namespace {

using test::hasProblem;

constexpr char kTissue[] = R"(description: a trial
law: neo_hookean
mu: 2.0e3
kappa: 1.0e5
density: 1050.0
viscoelastic: [{g: 0.45, tau: 0.5}, {g: 0.365, tau: 50}]
sources:
  - {values: "mu, viscoelastic", cite: "Nobody 1900", measured: nothing, read: not_read, note: made up}
choices:
  - {values: " kappa ,density", why: for a test}
)";

class TissueFiles : public ::testing::Test {
 protected:
  std::vector<Problem> problemsWith(std::string text, const std::string& from,
                                    const std::string& to) const {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    const std::string file = folder_.write("tissue.yaml", text);
    return test::problemsOf([&] { readTissueFile(file); });
  }
  material::Solid solidOf(const std::string& uri) const {
    MaterialConfig material;
    material.file = uri;
    return makeSolid(material, folder_.path("scenes/scene.yaml"), "organs[0].material");
  }

  test::TempFolder folder_;
};

TEST_F(TissueFiles, ValuesArriveWhereTheyBelong) {
  const TissueFile tissue = readTissueFile(folder_.write("tissue.yaml", kTissue));
  EXPECT_EQ(tissue.file, folder_.path("tissue.yaml"));
  EXPECT_EQ(tissue.description, "a trial");
  EXPECT_EQ(tissue.material.law, "neo_hookean");
  EXPECT_EQ(tissue.material.constants.at("mu"), std::vector<double>{2e3});
  EXPECT_EQ(tissue.material.viscoelastic.at(1).tau, 50.0);
  ASSERT_EQ(tissue.sources.size(), 1u);
  EXPECT_EQ(tissue.sources[0].values, "mu, viscoelastic");
  EXPECT_EQ(tissue.sources[0].cite, "Nobody 1900");
  EXPECT_EQ(tissue.sources[0].measured, "nothing");
  EXPECT_EQ(tissue.sources[0].read, "not_read");
  EXPECT_EQ(tissue.sources[0].note, "made up");
  ASSERT_EQ(tissue.choices.size(), 1u);
  EXPECT_EQ(tissue.choices[0].why, "for a test");
}

TEST_F(TissueFiles, PathsStartFromTheScene) {
  folder_.write("materials/tissue.yaml", kTissue);
  const material::Solid solid = solidOf("../materials/tissue.yaml");
  EXPECT_EQ(material::moduli(solid.law).mu, 2e3);
  EXPECT_EQ(solid.density, 1050.0);
  EXPECT_EQ(solid.prony.size(), 2u);
  EXPECT_EQ(material::moduli(solidOf(folder_.path("materials/tissue.yaml")).law).mu, 2e3);
}

TEST_F(TissueFiles, RefusalsNameTheFileAndTheKey) {
  EXPECT_TRUE(hasProblem(test::problemsOf([&] { solidOf("absent.yaml"); }),
                         "organs[0].material.file", "there is no file"));
  EXPECT_TRUE(hasProblem(test::problemsOf([&] { solidOf(std::string(10000, 'x')); }),
                         "organs[0].material.file", "there is no file"));
  EXPECT_TRUE(
      hasProblem(test::problemsOf([&] { solidOf("http://x/y"); }), "organs[0].material.file", ""));
  const std::string bad = folder_.write("bad.yaml",
                                        "description: x\nlaw: neo_hookean\nmu: -1\n"
                                        "kappa: 1\nsources: []\n");
  try {
    solidOf(bad);
    ADD_FAILURE() << "no InputError";
  } catch (const InputError& error) {
    EXPECT_EQ(error.file(), bad);
    EXPECT_TRUE(hasProblem(error.problems(), "mu", "> 0"));
    EXPECT_TRUE(hasProblem(error.problems(), "sources", "at least 1"));
  }
}

TEST_F(TissueFiles, RefusesWhatATissueIsNot) {
  EXPECT_TRUE(hasProblem(problemsWith(kTissue, "read: not_read", "read: yes"), "sources[0].read",
                         "first_hand, secondary, not_read"));
  EXPECT_TRUE(hasProblem(problemsWith(kTissue, "measured: nothing, ", ""), "sources[0].measured",
                         "is missing"));
  EXPECT_TRUE(hasProblem(problemsWith(kTissue, "law: neo", "file: a.yaml\nlaw: neo"), "file",
                         "no such key"));
  EXPECT_TRUE(
      hasProblem(problemsWith(kTissue, "description: a trial\n", ""), "description", "is missing"));
}

TEST_F(TissueFiles, EveryNumberHasASourceOrIsAChoice) {
  EXPECT_TRUE(hasProblem(problemsWith(kTissue, "mu, viscoelastic", "mu"), "",
                         "source or a choice for viscoelastic"));
  EXPECT_TRUE(hasProblem(problemsWith(kTissue, "kappa ,density", "poisson_ratio"), "",
                         "source or a choice for density, kappa"));
}

TEST_F(TissueFiles, RefusesSeriesThatLeaveNothing) {
  EXPECT_TRUE(hasProblem(problemsWith(kTissue, "g: 0.365", "g: 0.6"), "viscoelastic",
                         "sum of g = 1.05: must be < 1"));
  EXPECT_TRUE(
      hasProblem(problemsWith(kTissue, "g: 0.365", "g: 1"), "viscoelastic[1].g", "in (0, 1)"));
  EXPECT_TRUE(
      hasProblem(problemsWith(kTissue, "tau: 50", "tau: 0"), "viscoelastic[1].tau", "in (0"));
  EXPECT_TRUE(hasProblem(problemsWith(kTissue, "neo_hookean", "linear"), "viscoelastic",
                         "small rotations"));
}

}  // namespace
}  // namespace palpate::scene::tissue_file_test

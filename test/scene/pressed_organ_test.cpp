// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/scene/pressed_organ.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "palpate/scene/organ_assembly.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"

namespace palpate::scene::pressed_organ_test {
namespace {

constexpr char kHeldBelow[] = "{plane: {axis: z, at: 0.0, tolerance: 1.0e-4}}";
constexpr char kHarder[] =
    "    regions: [{name: hard, select: {half_space: {point: [0, 0, 0.015], normal: [0, 0, 1]}}, "
    "material: ";

/// What is written of the presses of a block, by which a database that is there is known again.
class PressesAreKnownAgain : public ::testing::Test {
 protected:
  std::string madeBy(const std::string& supports, const std::string& material,
                     const std::string& more = "") const {
    const std::string file = folder_.write(
        "scene.yaml", "name: pressed\ngravity: [0, 0, 0]\norgans:\n  - name: slab\n    surface: '" +
                          palpate::test::sourceFolder() +
                          "/config/organs/slab.obj'\n    edge_length: 0.02\n    material: " +
                          material + "\n    supports: [{select: " + supports + "}]\n" + more);
    const Scene scene = readScene(file);
    std::vector<std::string> warnings;
    const Progress none;
    enrichment::DatabasePlan plan;
    plan.triangles = 100;
    plan.splits = 0;
    plan.edge_length = 0.02;
    return describePresses(scene, 0, describeOrgan(scene, 0, none, &warnings), plan, none)
        .surfaces.made_by;
  }
  std::string tissue(const std::string& name, double young_modulus) const {
    folder_.write(
        name,
        "description: a test\nlaw: neo_hookean\nyoung_modulus: " + std::to_string(young_modulus) +
            "\npoisson_ratio: 0.3\ndensity: 1000\nsources:\n  - {values: 'young_modulus, "
            "poisson_ratio, density, law', cite: none, measured: nothing, read: "
            "not_read}\n");
    return "{file: " + name + "}";
  }

  const std::string soft_ =
      "{law: neo_hookean, young_modulus: 5.0e+3, poisson_ratio: 0.3, density: 1000}";

 private:
  const palpate::test::TempFolder folder_;
};

TEST_F(PressesAreKnownAgain, WhereNothingIsOther) {
  EXPECT_EQ(madeBy(kHeldBelow, soft_), madeBy(kHeldBelow, soft_));
  EXPECT_EQ(madeBy(kHeldBelow, tissue("one.yaml", 6e3)),
            madeBy(kHeldBelow, tissue("other.yaml", 6e3)));
}

// As many nodes are held on one side as on the other, or nearly.
TEST_F(PressesAreKnownAgain, UnlessOthersAreHeld) {
  const std::string left = "{box: {min: [-1, -1, -1], max: [-0.03, 1, 1]}}",
                    right = "{box: {min: [0.03, -1, -1], max: [1, 1, 1]}}";
  EXPECT_NE(madeBy(left, soft_), madeBy(right, soft_));
  EXPECT_NE(madeBy(left, soft_), madeBy(kHeldBelow, soft_));
}

TEST_F(PressesAreKnownAgain, UnlessATissueFileSaysOtherwise) {
  const std::string before = madeBy(kHeldBelow, tissue("one.yaml", 6e3));
  EXPECT_NE(madeBy(kHeldBelow, tissue("one.yaml", 7e3)), before);
}

TEST_F(PressesAreKnownAgain, UnlessARegionIsOfOtherTissue) {
  const std::string hard = kHarder + soft_ + "}]\n",
                    harder = kHarder + tissue("a.yaml", 9e3) + "}]\n",
                    hardest = kHarder + tissue("b.yaml", 9.1e3) + "}]\n";
  const std::string plain = madeBy(kHeldBelow, soft_);
  EXPECT_NE(madeBy(kHeldBelow, soft_, hard), plain);
  EXPECT_NE(madeBy(kHeldBelow, soft_, harder), madeBy(kHeldBelow, soft_, hard));
  EXPECT_NE(madeBy(kHeldBelow, soft_, hardest), madeBy(kHeldBelow, soft_, harder));
}

TEST_F(PressesAreKnownAgain, UnlessFibresRunOtherwise) {
  const std::string fibred =
      "{law: guccione, c: 1000, bf: 8, bt: 2, bfs: 4, kappa: 1.0e+4, density: 1000}";
  const std::string along = "    fibres: {direction: [1, 0, 0]}\n",
                    across = "    fibres: {direction: [0, 1, 0]}\n";
  EXPECT_EQ(madeBy(kHeldBelow, fibred, along), madeBy(kHeldBelow, fibred, along));
  EXPECT_NE(madeBy(kHeldBelow, fibred, along), madeBy(kHeldBelow, fibred, across));
}

}  // namespace
}  // namespace palpate::scene::pressed_organ_test

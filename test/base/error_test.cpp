// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/error.h"

#include <gtest/gtest.h>

namespace palpate {
namespace {

TEST(InputError, SaysFileKeyValueAndWhatIsAllowed) {
  const InputError error("scene.yaml", "organs[0].scale", "-1", "must be > 0");
  EXPECT_STREQ(error.what(), "scene.yaml: organs[0].scale = -1: must be > 0");
}

TEST(InputError, HasALineForEachProblem) {
  const InputError error("a.yaml", {{"x", "1", "bad"}, {"", "", "empty file"}});
  EXPECT_STREQ(error.what(), "a.yaml: x = 1: bad\na.yaml: empty file");
  EXPECT_EQ(error.problems().size(), 2u);
}

TEST(NearestName, FindsTyposAndNothingElse) {
  const std::vector<std::string> known{"young_modulus", "poisson_ratio", "density"};
  EXPECT_EQ(nearestName("youngs_modulus", known), "young_modulus");
  EXPECT_EQ(nearestName("densty", known), "density");
  EXPECT_EQ(nearestName("colour", known), "");
}

}  // namespace
}  // namespace palpate

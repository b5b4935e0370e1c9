// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/error.h"

#include <gtest/gtest.h>

namespace palpate::error_test {
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

// A terminal heeds what stands behind an escape, also behind the one of two bytes in UTF-8.
TEST(InputError, HasNoControlCharacters) {
  const InputError error("a.yaml", "k\ney",
                         "\x1b[2J\xC2\x9B"
                         "2J\t\x7F",
                         "must be\none of \x07 a, \xC3\xA4");
  EXPECT_STREQ(error.what(), "a.yaml: k?ey = ?[2J??2J??: must be\none of ? a, \xC3\xA4");
  EXPECT_EQ(error.problems()[0].value, "?[2J??2J??");
  EXPECT_STREQ(InputError("a\x1b.yaml", "", "", "is bad").what(), "a?.yaml: is bad");
}

TEST(InputError, IsShort) {
  const std::string much(1000000, 'x');
  const InputError error("a.yaml", much, much, "must be one of " + much);
  EXPECT_LT(std::string(error.what()).size(), 5000U);
  EXPECT_EQ(error.problems()[0].key, std::string(200, 'x') + "...");
}

TEST(NearestName, TakesNoTimeForLongNames) {
  const std::string much(1000000, 'x');
  EXPECT_EQ(nearestName(much, {much}), "");
  EXPECT_EQ(nearestName("density", {much, "densitys"}), "densitys");
}

TEST(NearestName, FindsTyposAndNothingElse) {
  const std::vector<std::string> known{"young_modulus", "poisson_ratio", "density"};
  EXPECT_EQ(nearestName("youngs_modulus", known), "young_modulus");
  EXPECT_EQ(nearestName("densty", known), "density");
  EXPECT_EQ(nearestName("colour", known), "");
}

}  // namespace
}  // namespace palpate::error_test

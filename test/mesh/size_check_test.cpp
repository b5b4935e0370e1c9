// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/size_check.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "palpate/base/error.h"

namespace palpate::mesh::size_check_test {
namespace {

Points boxOf(double x, double y, double z) {
  Points points(3, 2);
  points << 0.0, x, 0.0, y, 0.0, z;
  return points;
}

std::string messageOf(const Points& points) {
  try {
    checkSize(points, "organ.obj", "organs[0].surface");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(SizeCheck, AcceptsTheRangeWithItsEnds) {
  EXPECT_EQ(messageOf(boxOf(0.1, 0.2, 0.1)), "");
  EXPECT_EQ(messageOf(boxOf(1e-3, 0.0, 0.0)), "");
  EXPECT_EQ(messageOf(boxOf(0.0, 2.0, 0.0)), "");
}

TEST(SizeCheck, NamesTheScaleOfMillimetres) {
  const std::string text = messageOf(boxOf(220.0, 150.0, 100.0));
  EXPECT_TRUE(says(text, "organ.obj: organs[0].surface")) << text;
  EXPECT_TRUE(says(text, "220 m")) << text;
  EXPECT_TRUE(says(text, "millimetres: try `scale: 0.001`")) << text;
}

TEST(SizeCheck, NamesOtherUnits) {
  EXPECT_TRUE(says(messageOf(boxOf(2.2, 15.0, 10.0)), "centimetres: try `scale: 0.01`"));
  EXPECT_TRUE(says(messageOf(boxOf(1.5e5, 1.0, 1.0)), "micrometres: try `scale: 1e-06`"));
  EXPECT_TRUE(says(messageOf(boxOf(1.5e-4, 0.0, 0.0)), "kilometres: try `scale: 1000`"));
}

TEST(SizeCheck, ElseSuggestsAPowerOfTen) {
  EXPECT_TRUE(says(messageOf(boxOf(1.5e9, 0.0, 0.0)), "perhaps 1e-10"));
  EXPECT_TRUE(says(messageOf(boxOf(1.5e-8, 0.0, 0.0)), "perhaps 1e+07"));
}

TEST(SizeCheck, RefusesNothingAndNonsense) {
  EXPECT_TRUE(says(messageOf(Points(3, 0)), "no points"));
  EXPECT_TRUE(says(messageOf(boxOf(std::numeric_limits<double>::quiet_NaN(), 0.1, 0.1)), "finite"));
  EXPECT_TRUE(says(messageOf(boxOf(std::numeric_limits<double>::infinity(), 0.1, 0.1)), "finite"));
  EXPECT_TRUE(says(messageOf(boxOf(0.0, 0.0, 0.0)), "0 m"));
  EXPECT_NE(messageOf(boxOf(std::numeric_limits<double>::max(), -std::numeric_limits<double>::max(),
                            0.0)),
            "");
}

}  // namespace
}  // namespace palpate::mesh::size_check_test

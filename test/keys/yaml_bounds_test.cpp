// SPDX-License-Identifier: GPL-3.0-or-later
// YAML texts that would take all time or memory: refused with the place, before they do.
#include <gtest/gtest.h>

#include "palpate/keys/yaml_reader.h"
#include "support/contains.h"
#include "support/input_error.h"
#include "support/temp_folder.h"

namespace palpate::keys::yaml_bounds_test {
namespace {

struct Point {
  Vec3 at = Vec3::Zero();
};
void describe(FieldVisitor& v, Point& point) {
  v.vector3({"at", "m", "Place."}, point.at, Range::any());
}

struct Line {
  std::vector<Point> points;
};
void describe(FieldVisitor& v, Line& line) {
  v.list({"points", "", "Its points."}, line.points, 0);
}

class YamlBounds : public ::testing::Test {
 protected:
  std::vector<Line> read(const std::string& text) const {
    std::vector<Line> lines;
    readYaml(folder_.write("a.yaml", text), [&](FieldVisitor& v) {
      v.list({"lines", "", "Lines."}, lines, 0);
    });
    return lines;
  }
  std::string complaintOf(const std::string& text) const {
    return test::complaint([&] { read(text); });
  }
  test::TempFolder folder_;
};

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

// yaml-cpp finds empty documents without end in these.
TEST_F(YamlBounds, WordsThatBeginNothingAreRefused) {
  for (const std::string& text : {std::string(","), std::string("]"), std::string("a: 1\n,"),
                                  std::string(",\0\nr\x15\npseaklee", 14)}) {
    EXPECT_NE(complaintOf(text), "") << text;
  }
}

TEST_F(YamlBounds, NestingIsRefusedBelowFiftyLevels) {
  const auto nested = [](int levels) {
    return "lines: " + repeated("[", levels) + repeated("]", levels);
  };
  EXPECT_FALSE(test::contains(complaintOf(nested(49)), "nested"));
  EXPECT_TRUE(test::contains(complaintOf(nested(50)), "line 1: must not be nested deeper than 50"));
  for (const char* open : {"[", "{", "- ", "{a: ", "[{", "? ", "- ? ", "a: [", "&a [", "!!seq ["}) {
    EXPECT_NE(complaintOf(repeated(open, 200000)), "") << open;
    EXPECT_NE(complaintOf("lines:\n  " + repeated(open, 200000)), "") << open;
  }
}

TEST_F(YamlBounds, AliasesCountAsWhatTheyStandFor) {
  std::string text = "a0: &a0 [x, x]\n";
  for (int i = 1; i < 40; ++i) {
    const std::string below = "*a" + std::to_string(i - 1), name = "a" + std::to_string(i);
    text += name + ": &" + name + " [" + below + ", " + below + "]\n";
  }
  EXPECT_TRUE(test::contains(complaintOf(text), "must not have more than 200000 values"));
  EXPECT_TRUE(test::contains(complaintOf("lines: &a [*a]"), "must not stand within"));
  EXPECT_TRUE(test::contains(complaintOf("lines: &a {b: *a}"), "must not stand within"));
  EXPECT_TRUE(test::contains(complaintOf("lines: [*a]"), "is not YAML"));
}

TEST_F(YamlBounds, AliasesAreReadAsWhatTheyStandFor) {
  const std::vector<Line> lines =
      read("lines: [&l {points: [&p {at: [1, 2, 3]}, *p]}, *l, {points: [*p]}]");
  ASSERT_EQ(lines.size(), 3U);
  ASSERT_EQ(lines[1].points.size(), 2U);
  EXPECT_EQ(lines[1].points[1].at, Vec3(1, 2, 3));
  EXPECT_EQ(lines[2].points[0].at, Vec3(1, 2, 3));
}

// A list of a million places takes more memory than the file has bytes.
TEST_F(YamlBounds, ValuesAreCounted) {
  EXPECT_TRUE(
      test::contains(complaintOf("lines: [" + repeated(",", 1000000) + "]"), "200000 values"));
  EXPECT_TRUE(test::contains(
      complaintOf("lines: [" + repeated("{},", 100000) + repeated("{},", 100000) + "]"),
      "200000 values"));
  EXPECT_EQ(read("lines: [" + repeated("{},", 1000) + "]").size(), 1000U);
}

}  // namespace
}  // namespace palpate::keys::yaml_bounds_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/springs_file.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "palpate/base/error.h"
#include "palpate/springs/spring_grids.h"
#include "support/contains.h"
#include "support/temp_folder.h"

namespace palpate::springs::springs_file_test {
namespace {

using test::contains;

const std::string kPoints = "point,x,y,z,mass\n0,0,0,0,1\n1,0.1,0,0,2\n";
const std::string kHeader = "a,b,kind,stiffness,preload,length,damping\n";

class SpringsFile : public ::testing::Test {
 protected:
  std::string refusal(const std::string& text) const {
    folder_.write("s.csv", text);
    try {
      readSprings(folder_.path("s.csv"));
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }

  const test::TempFolder folder_;
};

TEST_F(SpringsFile, GivesBackTheSameBits) {
  const SpringNetwork network = triangleNetwork(triangleSprings({1.1e5, 0.31, 1.7e-3}, 0.013),
                                                0.013, triangleNodes(5, 4), 2.3);
  const std::string file = folder_.path("s.csv");
  writeSprings(file, network);
  const SpringNetwork read = readSprings(file);
  EXPECT_TRUE(read.points == network.points);
  EXPECT_TRUE(read.masses == network.masses);
  ASSERT_EQ(read.springs.size(), network.springs.size());
  for (std::size_t i = 0; i < read.springs.size(); ++i) {
    const Spring &r = read.springs[i], &s = network.springs[i];
    EXPECT_TRUE(r.a == s.a && r.b == s.b && r.kind == s.kind && r.stiffness == s.stiffness &&
                r.preload == s.preload && r.length == s.length && r.damping == s.damping);
  }
  const std::string bytes = test::fileBytes(file);
  writeSprings(file, read);
  EXPECT_EQ(test::fileBytes(file), bytes);
}

TEST_F(SpringsFile, ReadsBlanksAndComments) {
  folder_.write("s.csv",
                "# made by hand\r\n point , x,y,z,mass\r\n\r\n0,0,0,0, 1 \r\n1,1,0,0,2\r\n" +
                    kHeader + "# the one\n0,1,shear,3,-0.5,1,0.25");
  const SpringNetwork network = readSprings(folder_.path("s.csv"));
  ASSERT_EQ(network.springs.size(), 1U);
  EXPECT_EQ(network.springs[0].kind, SpringKind::kShear);
  EXPECT_EQ(network.springs[0].stiffness, 3.0);
  EXPECT_EQ(network.springs[0].preload, -0.5);
  EXPECT_EQ(network.springs[0].length, 1.0);
  EXPECT_EQ(network.springs[0].damping, 0.25);
  EXPECT_EQ(network.masses[1], 2.0);
}

TEST_F(SpringsFile, SaysWhatIsWrongWhere) {
  const auto spring = [&](const std::string& row) { return refusal(kPoints + kHeader + row); };
  EXPECT_EQ(spring("0,1,edge,1,0,1,0\n"), "");
  EXPECT_TRUE(contains(spring("0,2,edge,1,0,1,0\n"),
                       "s.csv: line 5, b = 2: must be one of the 2 points, from 0 on"));
  EXPECT_TRUE(contains(spring("0.5,1,edge,1,0,1,0\n"), "line 5, a = 0.5: must be one of"));
  EXPECT_TRUE(contains(spring("1,1,edge,1,0,1,0\n"), "line 5, b = 1: must be another point"));
  EXPECT_TRUE(
      contains(spring("0,1,bent,1,0,1,0\n"), "line 5, kind = bent: must be one of structural,"));
  EXPECT_TRUE(contains(spring("0,1,edge,-1,0,1,0\n"), "line 5, stiffness = -1: must be >= 0"));
  EXPECT_TRUE(contains(spring("0,1,edge,1,nan,1,0\n"), "line 5, preload = nan: must be a finite"));
  EXPECT_TRUE(contains(spring("0,1,edge,1,0,0,0\n"), "line 5, length = 0: must be > 0"));
  EXPECT_TRUE(contains(spring("0,1,edge,1,0,1,-2\n"), "line 5, damping = -2: must be >= 0"));
  EXPECT_TRUE(contains(spring("0,1,edge,1,0,1\n"), "line 5 = 6 values: must have 7"));
  EXPECT_TRUE(contains(refusal("point,x,y,z,mass\n0,0,0,0,-1\n" + kHeader),
                       "line 2, mass = -1: must be > 0"));
  EXPECT_TRUE(contains(refusal("point,x,y,z,mass\n1,0,0,0,1\n" + kHeader), "point = 1: must be 0"));
  EXPECT_TRUE(contains(refusal("point,x,y,z,mass\n0,0,0,0,1\na,b\n"), "must have 5"));
  EXPECT_TRUE(contains(refusal("a,b,c\n"), "the first row must be point,x,y,z,mass"));
  EXPECT_TRUE(contains(refusal(kPoints), "has no row a,b,kind"));
  EXPECT_TRUE(contains(refusal(""), "must begin with a row"));
  const std::string both = spring("0,7,edge,1,0,1,0\n0,1,edge,x,0,1,0\n");
  EXPECT_TRUE(contains(both, "line 5, b = 7") && contains(both, "line 6, stiffness = x")) << both;
  EXPECT_THROW(readSprings(folder_.path("absent.csv")), InputError);
}

TEST_F(SpringsFile, NamesNoMoreThanTwentyProblems) {
  std::string rows;
  for (int i = 0; i < 30; ++i) rows += "0,1,cord,3,0,1,0\n";
  const std::string said = refusal(kPoints + kHeader + rows);
  int problems = 0;
  for (std::size_t at = 0; (at = said.find("cord", at)) != std::string::npos; ++at) ++problems;
  EXPECT_EQ(problems, 20) << said;
}

TEST_F(SpringsFile, DoesNotWriteWhatItWouldNotRead) {
  SpringNetwork network = lineNetwork({{1.0, 1.0}, {0.0, 1.0}}, 0.1, 3, 1.0);
  network.springs[1].length = 0.0;
  EXPECT_THROW(writeSprings(folder_.path("s.csv"), network), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(folder_.path("s.csv")));
}

}  // namespace
}  // namespace palpate::springs::springs_file_test

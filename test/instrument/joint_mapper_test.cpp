// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/instrument/joint_mapper.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace palpate::instrument::joint_mapper_test {
namespace {

using Names = std::vector<std::string>;

class JointMapping : public ::testing::Test {
 protected:
  JointMapper::Status map(const Names& names, const std::vector<double>& positions) {
    return mapper.map(names, positions.data(), positions.size(), &q);
  }
  /// Expects a failure whose sentence has `part` in it, and untouched positions.
  void expectProblem(const JointMapper::Status& status, const std::string& part) {
    EXPECT_FALSE(status.ok());
    EXPECT_NE(status.problem.find(part), std::string::npos) << status.problem;
    EXPECT_EQ(q, before);
  }

  JointMapper mapper{{"x", "y", "yaw"}};
  const Eigen::VectorXd before = Eigen::VectorXd::Constant(3, 7.0);
  Eigen::VectorXd q = before;
};

TEST_F(JointMapping, TakesTheOrderGiven) {
  ASSERT_TRUE(map({"x", "y", "yaw"}, {1.0, 2.0, 3.0}).ok());
  EXPECT_EQ(q, Eigen::Vector3d(1.0, 2.0, 3.0));
}

TEST_F(JointMapping, ReordersAndLeavesOutExtras) {
  ASSERT_TRUE(map({"jaw", "yaw", "x", "y"}, {9.0, 3.0, 1.0, 2.0}).ok());
  EXPECT_EQ(q, Eigen::Vector3d(1.0, 2.0, 3.0));
}

TEST_F(JointMapping, FollowsNamesThatChange) {
  ASSERT_TRUE(map({"x", "y", "yaw"}, {1.0, 2.0, 3.0}).ok());
  ASSERT_TRUE(map({"yaw", "y", "x"}, {1.0, 2.0, 3.0}).ok());
  EXPECT_EQ(q, Eigen::Vector3d(3.0, 2.0, 1.0));
  ASSERT_TRUE(map({"x", "y", "yaw"}, {4.0, 5.0, 6.0}).ok());
  EXPECT_EQ(q, Eigen::Vector3d(4.0, 5.0, 6.0));
}

TEST_F(JointMapping, NamesEveryMissingJoint) {
  expectProblem(map({"y"}, {1.0}), "x, yaw");
  expectProblem(map({}, {}), "x, y, yaw");
}

TEST_F(JointMapping, RefusesAnotherNumberOfPositions) {
  expectProblem(map({"x", "y", "yaw"}, {1.0, 2.0}), "2 positions");
  expectProblem(map({"x", "y", "yaw"}, {}), "0 positions");
}

TEST_F(JointMapping, RefusesNonFinitePositionsOfWantedJointsOnly) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  expectProblem(map({"x", "y", "yaw"}, {1.0, nan, 3.0}), "'y'");
  expectProblem(map({"x", "y", "yaw"}, {1.0, 2.0, -inf}), "'yaw'");
  EXPECT_TRUE(map({"x", "y", "yaw", "jaw"}, {1.0, 2.0, 3.0, nan}).ok());
}

TEST_F(JointMapping, RefusesAJointGivenTwice) {
  expectProblem(map({"x", "y", "yaw", "x"}, {1.0, 2.0, 3.0, 4.0}), "'x'");
}

TEST_F(JointMapping, RecoversAfterAFailure) {
  ASSERT_TRUE(map({"x", "y", "yaw"}, {1.0, 2.0, 3.0}).ok());
  q = before;
  expectProblem(map({"x", "y"}, {1.0, 2.0}), "yaw");
  ASSERT_TRUE(map({"x", "y", "yaw"}, {1.0, 2.0, 3.0}).ok());
  EXPECT_EQ(q, Eigen::Vector3d(1.0, 2.0, 3.0));
}

TEST(JointMapper, WantsNothingFromAnInstrumentWithoutJoints) {
  JointMapper mapper({});
  Eigen::VectorXd q;
  const double position = 1.0;
  EXPECT_TRUE(mapper.map({}, nullptr, 0, &q).ok());
  EXPECT_TRUE(mapper.map({"x"}, &position, 1, &q).ok());
  EXPECT_EQ(q.size(), 0);
}

}  // namespace
}  // namespace palpate::instrument::joint_mapper_test

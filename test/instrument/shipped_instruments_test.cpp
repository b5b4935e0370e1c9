// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "palpate/contact/signed_distance.h"
#include "palpate/formats/surface_io.h"
#include "palpate/instrument/instrument.h"
#include "palpate/instrument/mesh_shape.h"
#include "support/source_folder.h"

namespace palpate::instrument::shipped_instruments_test {
namespace {

/// An instrument and its poses at joints given by name, the others at zero.
class Shipped : public ::testing::Test {
 protected:
  explicit Shipped(const std::string& name)
      : instrument(readInstrument(test::sourceFolder() + "/config/instruments/" + name)) {}

  Pose pose(const std::string& link, const std::map<std::string, double>& positions = {}) const {
    const std::vector<std::string> names = instrument.jointNames();
    Eigen::VectorXd q = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(names.size()));
    for (const auto& [joint, position] : positions) {
      const auto at = std::find(names.begin(), names.end(), joint);
      EXPECT_NE(at, names.end()) << joint;
      q[at - names.begin()] = position;
    }
    std::vector<Pose> X;
    instrument.linkPoses(q, &X);
    const int index = instrument.linkIndex(link);
    EXPECT_GE(index, 0) << link;
    return X[static_cast<std::size_t>(index)];
  }
  Vec3 tip(const std::map<std::string, double>& positions = {}) const {
    return pose("tip", positions).translation();
  }
  void expectNear(const Vec3& a, const Vec3& b) const {
    EXPECT_LT((a - b).norm(), 1e-12) << a.transpose() << " is not " << b.transpose();
  }
  /// Distance of a point given in the root's frame to the nearest collision body at rest.
  double distanceAtRest(const Vec3& p_B) const {
    std::vector<Pose> X;
    instrument.linkPoses(
        Eigen::VectorXd::Zero(static_cast<Eigen::Index>(instrument.joints().size())), &X);
    double nearest = 1e9;
    for (const CollisionBody& body : instrument.bodies()) {
      const Pose X_BG = X[static_cast<std::size_t>(body.link)] * body.X_LG;
      nearest =
          std::min(nearest, contact::signedDistanceValue(body.geometry, X_BG.inverse() * p_B));
    }
    return nearest;
  }

  const Instrument instrument;
};

class Probe : public Shipped {
 protected:
  Probe() : Shipped("probe.urdf") {}
};
class Grasper : public Shipped {
 protected:
  Grasper() : Shipped("grasper.urdf") {}
};

TEST_F(Probe, HasSixJointsAndNothingOdd) {
  EXPECT_EQ(instrument.jointNames(),
            (std::vector<std::string>{"x", "y", "z", "roll", "pitch", "yaw"}));
  for (int i = 0; i < 6; ++i)
    EXPECT_EQ(instrument.joints()[static_cast<std::size_t>(i)].prismatic, i < 3);
  EXPECT_TRUE(instrument.warnings().empty());
  for (const Joint& joint : instrument.joints()) EXPECT_LT(joint.lower, joint.upper);
}

TEST_F(Probe, TipIsTheBallsCentreAtTheOriginAndMovesWithXyz) {
  EXPECT_EQ(pose("tip").matrix(), Pose::Identity().matrix());
  expectNear(tip({{"x", 0.1}, {"y", -0.2}, {"z", 0.3}}), Vec3(0.1, -0.2, 0.3));
}

TEST_F(Probe, RotationsLeaveTheTipAndTurnTheShaft) {
  const double a = 0.4;
  const Vec3 up = Vec3::UnitZ();  // where the shaft points
  expectNear(tip({{"x", 0.1}, {"roll", 0.3}, {"pitch", -0.2}, {"yaw", 1.0}}), Vec3(0.1, 0.0, 0.0));
  expectNear(pose("tip", {{"roll", a}}).linear() * up, Vec3(0.0, -std::sin(a), std::cos(a)));
  expectNear(pose("tip", {{"pitch", a}}).linear() * up, Vec3(std::sin(a), 0.0, std::cos(a)));
  expectNear(pose("tip", {{"yaw", a}}).linear() * up, up);
  expectNear(pose("tip", {{"yaw", a}}).linear() * Vec3::UnitX(),
             Vec3(std::cos(a), std::sin(a), 0.0));
}

TEST_F(Probe, IsABallOfFiveMillimetresUnderAShaftOfThree) {
  EXPECT_NEAR(distanceAtRest(Vec3(0.0, 0.0, -0.01)), 0.005, 1e-12);
  EXPECT_NEAR(distanceAtRest(Vec3(0.01, 0.0, 0.0)), 0.005, 1e-12);
  EXPECT_NEAR(distanceAtRest(Vec3(0.01, 0.0, 0.1)), 0.007, 1e-12);
  EXPECT_NEAR(distanceAtRest(Vec3(0.0, 0.0, 0.262)), 0.01, 1e-12);
}

TEST_F(Grasper, HasSevenDrivenJointsAndNothingOdd) {
  EXPECT_EQ(instrument.jointNames(),
            (std::vector<std::string>{"yaw", "pitch", "insertion", "roll", "wrist_pitch",
                                      "wrist_yaw", "jaw_left"}));
  EXPECT_EQ(instrument.linkNames()[0], "remote_center");
  EXPECT_TRUE(instrument.warnings().empty());
}

TEST_F(Grasper, InsertionIsTheDepthOfTheTip) {
  expectNear(tip(), Vec3::Zero());
  expectNear(tip({{"insertion", 0.1}}), Vec3(0.0, 0.0, -0.1));
}

TEST_F(Grasper, YawAndPitchSwingTheTipAboutTheRemoteCentre) {
  const double a = 0.3, d = 0.15;
  expectNear(tip({{"insertion", d}, {"yaw", a}}), d * Vec3(-std::sin(a), 0.0, -std::cos(a)));
  expectNear(tip({{"insertion", d}, {"pitch", a}}), d * Vec3(0.0, std::sin(a), -std::cos(a)));
  EXPECT_NEAR(tip({{"insertion", d}, {"yaw", 0.4}, {"pitch", -0.5}, {"roll", 2.0}}).norm(), d,
              1e-12);
}

TEST_F(Grasper, TheShaftAlwaysGoesThroughTheRemoteCentre) {
  for (const double d : {0.03, 0.1, 0.24}) {
    for (const double yaw : {-1.0, 0.2}) {
      for (const double pitch : {-0.8, 0.5}) {
        const Pose X = pose("shaft", {{"insertion", d},
                                      {"yaw", yaw},
                                      {"pitch", pitch},
                                      {"roll", 1.0},
                                      {"wrist_pitch", 0.7},
                                      {"jaw_left", 0.3}});
        const Vec3 center_L = X.inverse() * Vec3::Zero();  // the remote centre, seen by the shaft
        EXPECT_LT(center_L.head<2>().norm(), 1e-12);
        EXPECT_NEAR(center_L.z(), d - 0.029, 1e-12);
      }
    }
  }
}

TEST_F(Grasper, RollTurnsAboutTheShaft) {
  const double d = 0.1, a = 0.6;
  expectNear(tip({{"insertion", d}, {"roll", a}}), Vec3(0.0, 0.0, -d));
  expectNear(pose("tip", {{"roll", a}}).linear() * Vec3::UnitX(),
             Vec3(std::cos(a), -std::sin(a), 0.0));
}

TEST_F(Grasper, WristBendsAtItsTwoAxes) {
  const double d = 0.1, a = 0.5;
  expectNear(tip({{"insertion", d}, {"wrist_pitch", a}}),
             Vec3(0.0, 0.029 * std::sin(a), 0.029 - d - 0.029 * std::cos(a)));
  expectNear(tip({{"insertion", d}, {"wrist_yaw", a}}),
             Vec3(-0.020 * std::sin(a), 0.0, 0.020 - d - 0.020 * std::cos(a)));
}

TEST_F(Grasper, JawsOpenSymmetricallyAboutTheTip) {
  const double a = 0.4;
  const Vec3 end(0.0, 0.0, -0.020);
  const Vec3 left = pose("jaw_left_link", {{"jaw_left", a}}) * end;
  const Vec3 right = pose("jaw_right_link", {{"jaw_left", a}}) * end;
  expectNear(left, Vec3(0.020 * std::sin(a), 0.0, 0.020 - 0.020 * std::cos(a)));
  expectNear(right, Vec3(-left.x(), 0.0, left.z()));
  expectNear(pose("jaw_left_link") * end, tip());
  expectNear(tip({{"jaw_left", a}}), tip());
}

TEST_F(Grasper, IsEightMillimetresThickWithClosedJaws) {
  EXPECT_NEAR(distanceAtRest(Vec3(0.01, 0.0, 0.2)), 0.006, 1e-12);
  EXPECT_NEAR(distanceAtRest(Vec3(0.002, 0.0, -0.003)), 0.003, 1e-12);
  EXPECT_NEAR(distanceAtRest(Vec3(0.007, 0.0, 0.002)), 0.003, 1e-12);
  EXPECT_NEAR(distanceAtRest(Vec3(0.0, 0.0, 0.01)), 0.0, 1e-12);  // where the jaws touch
  EXPECT_LT(distanceAtRest(Vec3(0.0, 0.0, 0.027)), 0.0);          // no gap at the wrist
  EXPECT_LT(distanceAtRest(Vec3(0.0, 0.0, 0.034)), 0.0);
}

std::string extraData() {
  const char* folder = std::getenv("PALPATE_EXTRA_DATA");
  return folder == nullptr ? "" : folder;
}

TEST(ExtraInstruments, PsmLoadsAndMovesWithoutItsVisualMeshes) {
  if (extraData().empty())
    GTEST_SKIP() << "needs instruments that are not shipped: a folder in PALPATE_EXTRA_DATA";
  InstrumentOptions options;
  options.collision_meshes.convex_hull = true;  // one of its meshes cuts itself
  const Instrument psm = readInstrument(extraData() + "/instruments/psm/psm.urdf", options);
  EXPECT_GT(psm.warnings().size(), 5u);
  EXPECT_GE(psm.bodies().size(), 4u);
  int hulls = 0;
  for (const CollisionBody& body : psm.bodies()) {
    hulls += std::holds_alternative<ConvexHull>(body.geometry);
    EXPECT_LT(contact::boundingRadius(body.geometry), 1.0) << body.name;
    EXPECT_GT(contact::inscribedRadius(body.geometry), 1e-4) << body.name;
  }
  EXPECT_EQ(hulls, 2);

  const auto names = psm.jointNames();
  const auto at = [&](const std::string& joint) {
    const auto found = std::find(names.begin(), names.end(), joint);
    EXPECT_NE(found, names.end()) << joint;
    return found - names.begin();
  };
  EXPECT_EQ(std::count(names.begin(), names.end(), "psm_pitch_end_joint"), 0);  // a mimic
  const int tip = psm.linkIndex("psm_tool_tip_link");
  ASSERT_GE(tip, 0);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(names.size()));
  std::vector<Pose> rest, moved;
  psm.linkPoses(q, &rest);
  q[at("psm_main_insertion_joint")] = 0.1;
  psm.linkPoses(q, &moved);
  const auto i = static_cast<std::size_t>(tip);
  EXPECT_NEAR((moved[i].translation() - rest[i].translation()).norm(), 0.1, 1e-12);
  // The pitch of the arm reaches the tool through the mimics of its parallelogram.
  q[at("psm_pitch_back_joint")] = 0.3;
  psm.linkPoses(q, &rest);
  EXPECT_GT((moved[i].translation() - rest[i].translation()).norm(), 0.01);
}

TEST(ExtraInstruments, CollisionMeshesOfThePsmsToolHaveAShapeOrAreRefusedWithAReason) {
  if (extraData().empty())
    GTEST_SKIP() << "needs instruments that are not shipped: a folder in PALPATE_EXTRA_DATA";
  int sampled = 0, refused = 0;
  const std::string folder = extraData() + "/instruments/psm/meshes/collision";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string file = entry.path().string();
    if (entry.path().filename().string().rfind("tool_", 0) != 0) continue;  // others are large
    std::cout << entry.path().filename().string() << ": ";
    try {
      const MeshShape shape = shapeOfMesh(formats::readSurface(file), file, {});
      const auto* surface = std::get_if<SampledSurface>(&shape.geometry);
      std::cout << (surface ? shape.note : "convex") << "\n";
      if (!surface) continue;
      ++sampled;
      EXPECT_TRUE(surface->grid->limited || surface->grid->largest_error <= 1e-4) << file;
      EXPECT_GT(surface->grid->inscribed_radius, 1e-4) << file;
    } catch (const std::invalid_argument& error) {
      ++refused;
      std::cout << error.what() << "\n";
      EXPECT_NE(std::string(error.what()).find("convex_hull: true"), std::string::npos) << file;
    }
  }
  EXPECT_GT(sampled, 0);
  EXPECT_GT(refused, 0);
}

TEST(ExtraInstruments, OmniIsAnArmWithoutCollisionShapes) {
  if (extraData().empty())
    GTEST_SKIP() << "needs instruments that are not shipped: a folder in PALPATE_EXTRA_DATA";
  const Instrument omni = readInstrument(extraData() + "/instruments/omni.urdf");
  EXPECT_EQ(omni.joints().size(), 6u);
  EXPECT_TRUE(omni.bodies().empty());
  EXPECT_EQ(omni.warnings().size(), 7u);  // one a visual mesh
}

}  // namespace
}  // namespace palpate::instrument::shipped_instruments_test

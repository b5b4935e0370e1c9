// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/instrument/instrument.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <thread>

#include "support/source_folder.h"
#include "support/temp_folder.h"
#include "urdf_text.h"

namespace palpate::instrument::instrument_test {
namespace {

using test::TempFolder;

constexpr double kPi = 3.14159265358979323846;

Instrument readText(const std::string& text, const InstrumentOptions& options = {}) {
  const TempFolder temp;
  return readInstrument(temp.write("a.urdf", text), options);
}

const std::string kTetrahedronObj =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST(Instrument, LinksAndJointsComeDepthFirstInTheFilesOrder) {
  // Sorted by name, joints and links would come the other way round.
  const Instrument instrument = readText(robot(
      link("c") + link("z") + link("y") + link("x") + joint("z2", "continuous", "z", "x") +
      joint("z1", "prismatic", "c", "z", limit()) + joint("a1", "revolute", "c", "y", limit())));
  EXPECT_EQ(instrument.name(), "r");
  EXPECT_EQ(instrument.linkNames(), (std::vector<std::string>{"c", "z", "x", "y"}));
  EXPECT_EQ(instrument.jointNames(), (std::vector<std::string>{"z1", "z2", "a1"}));
  EXPECT_EQ(instrument.linkIndex("x"), 2);
  EXPECT_EQ(instrument.linkIndex("w"), -1);
  EXPECT_TRUE(instrument.joints()[0].prismatic);
  EXPECT_FALSE(instrument.joints()[2].prismatic);
  EXPECT_EQ(instrument.joints()[0].lower, -1.0);
  EXPECT_EQ(instrument.joints()[0].upper, 1.0);
  EXPECT_EQ(instrument.joints()[1].lower, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(instrument.joints()[1].upper, std::numeric_limits<double>::infinity());
}

TEST(Instrument, MovesAsItsJointsSay) {
  const Instrument instrument = readText(robot(
      link("base") + link("slide") + link("arm") + link("hand") +
      joint("s", "prismatic", "base", "slide",
            limit() +
                "<origin xyz=\"1 0 0\" rpy=\"0 0 1.57079632679489662\"/><axis xyz=\"2 0 0\"/>") +
      joint("r", "revolute", "slide", "arm", limit() + "<axis xyz=\"0 0 1\"/>") +
      joint("f", "fixed", "arm", "hand", "<origin xyz=\"1 0 0\"/>")));
  std::vector<Pose> X;
  instrument.linkPoses(Eigen::Vector2d(0.5, 0.5 * kPi), &X);
  // The slide's x is the base's y, and an axis is a direction whatever its length.
  EXPECT_LT((X[1].translation() - Vec3(1.0, 0.5, 0.0)).norm(), 1e-15);
  EXPECT_LT((X[3].translation() - Vec3(0.0, 0.5, 0.0)).norm(), 1e-15);
  EXPECT_LT((X[3].linear() * Vec3::UnitX() - Vec3(-1.0, 0.0, 0.0)).norm(), 1e-15);
  EXPECT_EQ(X[0].matrix(), Pose::Identity().matrix());
}

TEST(Instrument, JointWithoutAxisTurnsAboutX) {
  const Instrument instrument =
      readText(robot(link("a") + link("b") + joint("j", "continuous", "a", "b")));
  std::vector<Pose> X;
  instrument.linkPoses(Eigen::VectorXd::Constant(1, 0.5 * kPi), &X);
  EXPECT_LT((X[1].linear() * Vec3::UnitY() - Vec3::UnitZ()).norm(), 1e-15);
}

TEST(Instrument, MimicsFollowAlsoInChainsAndAcrossKinds) {
  const std::string follows_second =
      limit() + "<axis xyz=\"1 0 0\"/><mimic joint=\"j2\" multiplier=\"-2\" offset=\"0.1\"/>";
  const std::string follows_third =
      limit() + "<axis xyz=\"1 0 0\"/><mimic joint=\"j3\" multiplier=\"0.5\" offset=\"1\"/>";
  const Instrument instrument =
      readText(robot(link("a") + link("b") + link("c") + link("d") +
                     joint("j1", "prismatic", "a", "b", follows_second) +
                     joint("j2", "prismatic", "a", "c", follows_third) +
                     joint("j3", "revolute", "a", "d", limit() + "<axis xyz=\"1 0 0\"/>")));
  EXPECT_EQ(instrument.jointNames(), std::vector<std::string>{"j3"});
  std::vector<Pose> X;
  instrument.linkPoses(Eigen::VectorXd::Constant(1, 0.6), &X);
  const double j2 = 0.5 * 0.6 + 1.0, j1 = -2.0 * j2 + 0.1;
  EXPECT_NEAR(X[1].translation().x(), j1, 1e-15);
  EXPECT_NEAR(X[2].translation().x(), j2, 1e-15);
}

TEST(Instrument, MimicWithoutMultiplierCopies) {
  const Instrument instrument = readText(
      robot(link("a") + link("b") + link("c") + joint("j", "prismatic", "a", "b", limit()) +
            joint("k", "prismatic", "a", "c", limit() + "<mimic joint=\"j\"/>")));
  std::vector<Pose> X;
  instrument.linkPoses(Eigen::VectorXd::Constant(1, 0.25), &X);
  EXPECT_EQ(X[1].translation(), X[2].translation());
  EXPECT_EQ(X[2].translation().x(), 0.25);
}

TEST(Instrument, PosesHaveTheSameBitsOnEveryThread) {
  const Instrument instrument =
      readInstrument(test::sourceFolder() + "/config/instruments/grasper.urdf");
  const auto n = static_cast<Eigen::Index>(instrument.joints().size());
  const auto run = [&](std::vector<Pose>* X) {
    for (int i = 0; i < 2000; ++i) instrument.linkPoses(Eigen::VectorXd::Constant(n, 1e-3 * i), X);
  };
  std::vector<Pose> a, b, c;
  std::thread first([&] { run(&a); }), second([&] { run(&b); });
  first.join();
  second.join();
  run(&c);
  for (std::size_t i = 0; i < c.size(); ++i) {
    EXPECT_EQ(std::memcmp(a[i].data(), c[i].data(), 16 * sizeof(double)), 0);
    EXPECT_EQ(std::memcmp(b[i].data(), c[i].data(), 16 * sizeof(double)), 0);
  }
}

TEST(Instrument, RefusesAnotherNumberOfPositions) {
  const Instrument instrument =
      readText(robot(link("a") + link("b") + joint("j", "continuous", "a", "b")));
  std::vector<Pose> X;
  EXPECT_THROW(instrument.linkPoses(Eigen::VectorXd::Zero(2), &X), std::invalid_argument);
  EXPECT_THROW(instrument.linkPoses(Eigen::VectorXd::Zero(0), &X), std::invalid_argument);
}

TEST(CollisionShapes, SphereBoxAndCylinder) {
  const Instrument instrument = readText(robot(
      link("a", collision("<sphere radius=\"0.5\"/>") + collision("<box size=\"1 2 3\"/>", "b")) +
      link("c", collision("<cylinder radius=\"0.1\" length=\"2\"/>")) +
      joint("j", "fixed", "a", "c")));
  ASSERT_EQ(instrument.bodies().size(), 3u);
  EXPECT_EQ(instrument.bodies()[0].name, "a");
  EXPECT_EQ(instrument.bodies()[1].name, "a/b");
  EXPECT_EQ(instrument.bodies()[2].link, 1);
  EXPECT_EQ(std::get<Sphere>(instrument.bodies()[0].geometry).radius, 0.5);
  EXPECT_EQ(std::get<Box>(instrument.bodies()[1].geometry).half_extents, Vec3(0.5, 1.0, 1.5));
  const auto& capsule = std::get<Capsule>(instrument.bodies()[2].geometry);
  EXPECT_EQ(capsule.radius, 0.1);
  EXPECT_DOUBLE_EQ(2.0 * (capsule.half_length + capsule.radius), 2.0);
  EXPECT_TRUE(instrument.warnings().empty());
}

TEST(CollisionShapes, OriginPlacesTheShape) {
  const Instrument instrument =
      readText(robot(link("a",
                          "<collision><origin xyz=\"1 2 3\" rpy=\"0.1 0.2 0.3\"/><geometry><sphere "
                          "radius=\"1\"/></geometry></collision>")));
  const Pose expected = poseFromXyzRpy(Vec3(1.0, 2.0, 3.0), Vec3(0.1, 0.2, 0.3));
  EXPECT_LT((instrument.bodies()[0].X_LG.matrix() - expected.matrix()).norm(), 1e-15);
}

TEST(CollisionShapes, CylinderCanHaveFlatEnds) {
  const std::string text = robot(link("a", collision("<cylinder radius=\"0.1\" length=\"2\"/>")));
  InstrumentOptions options;
  options.cylinder_as_capsule = false;
  const Instrument instrument = readText(text, options);
  const auto& cylinder = std::get<Cylinder>(instrument.bodies()[0].geometry);
  EXPECT_EQ(cylinder.radius, 0.1);
  EXPECT_EQ(cylinder.half_length, 1.0);
}

TEST(CollisionShapes, ShortCylinderIsABallAndSaysSo) {
  const Instrument instrument =
      readText(robot(link("a", collision("<cylinder radius=\"0.1\" length=\"0.1\"/>"))));
  EXPECT_EQ(std::get<Capsule>(instrument.bodies()[0].geometry).half_length, 0.0);
  ASSERT_EQ(instrument.warnings().size(), 1u);
  EXPECT_NE(instrument.warnings()[0].find("shorter than thick"), std::string::npos);
}

TEST(CollisionShapes, MeshesByEveryKindOfNameWithScale) {
  const TempFolder temp;
  const std::string mesh = temp.write("arm/meshes/t.obj", kTetrahedronObj);
  temp.write("arm/package.xml", "<package><name>arm_description</name></package>");
  for (const std::string& name : {std::string("../meshes/t.obj"), mesh, "file://" + mesh,
                                  std::string("package://arm_description/meshes/t.obj")}) {
    const std::string shape = "<mesh filename=\"" + name + "\" scale=\"0.1 0.2 -0.3\"/>";
    const Instrument instrument =
        readInstrument(temp.write("arm/urdf/a.urdf", robot(link("a", collision(shape)))));
    const auto& hull = std::get<ConvexHull>(instrument.bodies()[0].geometry);
    EXPECT_EQ(hull.surface.points.rowwise().maxCoeff(), Vec3(0.1, 0.2, 0.0)) << name;
    EXPECT_EQ(hull.surface.points.rowwise().minCoeff(), Vec3(0.0, 0.0, -0.3)) << name;
    EXPECT_NEAR(mesh::enclosedVolume(hull.surface), 0.006 / 6.0, 1e-17) << name;
  }
}

TEST(CollisionShapes, MissingVisualMeshIsAWarning) {
  const Instrument instrument = readText(robot(
      link("a",
           "<visual><geometry><mesh filename=\"none.stl\"/></geometry></visual>"
           "<visual><geometry><mesh filename=\"package://no_such/n.stl\"/></geometry></visual>"
           "<visual><geometry><sphere radius=\"1\"/></geometry></visual>")));
  ASSERT_EQ(instrument.warnings().size(), 2u);
  EXPECT_NE(instrument.warnings()[0].find("none.stl"), std::string::npos);
  EXPECT_NE(instrument.warnings()[1].find("no_such"), std::string::npos);
  EXPECT_TRUE(instrument.bodies().empty());
}

}  // namespace
}  // namespace palpate::instrument::instrument_test

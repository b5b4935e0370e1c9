// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "palpate/contact/contact_potential.h"
#include "palpate/contact/signed_distance.h"
#include "palpate/mesh/tet_mesh.h"
#include "support/no_jumps.h"
#include "support/random.h"

namespace palpate::contact::face_contact_test {
namespace {

using instrument::Box;
using instrument::Capsule;
using instrument::Cylinder;
using instrument::Geometry;
using instrument::Sphere;

constexpr double kSpacing = 5e-3;  // of samples [m]

struct Tool {
  const char* name;
  Geometry geometry;
  double lowest;  // of its points, upright [m]
};

const Tool kNeedle{"needle", Capsule{2.5e-4, 0.03}, -0.03 - 2.5e-4};
const Tool kThinRod{"flat needle", Cylinder{2.5e-4, 0.03}, -0.03};
const Tool kBlade{"blade", Box{Vec3(5e-3, 1e-4, 0.015)}, -0.015};
const Tool kBall{"small ball", Sphere{1e-3}, -1e-3};
const Tool kBox{"box", Box{Vec3(6e-3, 5e-3, 4e-3)}, -4e-3};
const Tool kTools[] = {kNeedle, kThinRod, kBlade, kBall, kBox};

// A block with its upper face at z = 0 and triangles of 10 mm.
struct Block {
  explicit Block(const std::string& response = "penalty")
      : potential(sampleSurface(mesh.points, triangles, kSpacing),
                  makeResponse({response, 1e7, 1e-4})) {
    mesh.points.row(0).array() -= 0.02;
    mesh.points.row(1).array() -= 0.02;
    mesh.points.row(2).array() -= 0.02;
    potential.addFaceContact(mesh.points, triangles, kSpacing);
  }
  void place(const Tool& tool, const Pose& X_WG) {
    potential.setObstacles({{&tool.geometry, 0, X_WG, X_WG}});
    potential.findCandidates(mesh.points, {5e-3});
  }
  Vec3 forceOnTissue() const {
    Points g = Points::Zero(3, mesh.numPoints());
    potential.addGradient(mesh.points, &g);
    return -g.rowwise().sum();
  }

  mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.04, 0.04, 0.02), Eigen::Vector3i(4, 4, 2));
  Eigen::Matrix3Xi triangles = mesh::boundaryTriangles(mesh.tets);
  ContactPotential potential;
};

class FaceContact : public ::testing::TestWithParam<int> {
 public:
  const Tool& tool() const { return kTools[GetParam()]; }
  // Its lowest point at that depth under the face.
  Pose upright(double x, double y, double depth) const {
    return poseFromXyzRpy(Vec3(x, y, -depth - tool().lowest), Vec3::Zero());
  }

  test::Random random;
  Block block;
};

// Wherever it stands, on a face or an edge, a tool is met, though no sample need be in it.
TEST_P(FaceContact, MeetsLargeTriangles) {
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 at = random.vector(0.009);
    block.place(tool(), upright(at.x(), at.y(), 2e-5));
    const Vec3 force = block.forceOnTissue();
    EXPECT_LT(force.z(), -1e-5) << tool().name << " at " << at.transpose();
    // A ball of 1 mm at a depth of 20 um also touches the edge of an adjacent triangle, within 0.2
    // mm. The force may be inclined by the sine of that.
    EXPECT_LT(force.head<2>().norm(), 0.3 * -force.z()) << at.transpose();
    block.place(tool(), upright(at.x(), at.y(), -1e-5));
    EXPECT_EQ(block.forceOnTissue(), Vec3(Vec3::Zero())) << at.transpose();
  }
}

// What is known of a place from one question is no more than another one there would find, in
// whichever order, with a longer step before it, and where the tool or the block is elsewhere.
TEST_P(FaceContact, AnswersAsOneThatWasNeverAsked) {
  const auto force = [](const Block& of, const Points& x) {
    Points g = Points::Zero(3, x.cols());
    of.potential.addGradient(x, &g);
    return g;
  };
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3 at = random.vector(0.009);
    block.place(tool(), upright(at.x(), at.y(), 1.7e-4));
    for (int k = 0; k < 3; ++k) {
      const Points x = block.mesh.points + random.points(block.mesh.numPoints(), 1e-4);
      const Points d = random.points(x.cols(), k == 1 ? 1e-2 : 1e-5);
      const Pose X_WG = upright(at.x(), at.y(), 1e-4 * k);
      block.potential.setObstacles({{&tool().geometry, 0, X_WG, X_WG}});
      Block fresh;
      fresh.place(tool(), upright(at.x(), at.y(), 1.7e-4));
      fresh.potential.setObstacles({{&tool().geometry, 0, X_WG, X_WG}});
      if (k == 2) block.potential.value(x);
      const double longest = block.potential.maxStep(x, d);
      const Points g = force(block, x);
      EXPECT_EQ(g, force(fresh, x)) << tool().name;
      EXPECT_EQ(longest, fresh.potential.maxStep(x, d)) << tool().name;
      EXPECT_EQ(block.potential.value(x), fresh.potential.value(x)) << tool().name;
      // The tool alone moves.
      block.place(tool(), upright(at.x(), at.y(), 0.5e-4));
      block.potential.value(x);
      block.potential.setObstacles({{&tool().geometry, 0, X_WG, X_WG}});
      EXPECT_LT((g - force(block, x)).norm(), 1e-9 * (1.0 + g.norm())) << tool().name;
      block.place(tool(), upright(at.x(), at.y(), 1.7e-4));
    }
  }
}

// On a long way the triangle that was nearest before bounds the search; what is left out then is
// nothing that answers.
TEST_P(FaceContact, AnswersOnALongWayAsWhereNothingIsLeftOut) {
  Block whole;
  whole.potential.setSkips(true, false);
  const Pose first = upright(0.0, 0.0, -0.02);
  for (Block* of : {&block, &whole}) {
    of->potential.setObstacles({{&tool().geometry, 0, first, first}});
    of->potential.findCandidates(of->mesh.points, {0.1});
  }
  int answered = 0;
  for (int k = 0; k < 120; ++k) {
    const double part = k / 119.0;  // down through the block and out at its side
    const Pose X_WG = upright(0.04 * part * part, 0.01 * part, 0.06 * part - 0.02);
    const Points x = block.mesh.points + random.points(block.mesh.numPoints(), 1e-4);
    const Points d = random.points(x.cols(), 1e-3);
    Points g = Points::Zero(3, x.cols()), g_whole = g;
    for (Block* of : {&block, &whole}) {
      of->potential.setObstacles({{&tool().geometry, 0, X_WG, X_WG}});
      of->potential.addGradient(x, of == &block ? &g : &g_whole);
    }
    EXPECT_EQ(g, g_whole) << tool().name << " " << k;
    EXPECT_EQ(block.potential.value(x), whole.potential.value(x)) << tool().name << " " << k;
    EXPECT_EQ(block.potential.maxStep(x, d), whole.potential.maxStep(x, d)) << tool().name;
    answered += !g.isZero(0.0);
  }
  EXPECT_GT(answered, 20);
}

TEST_P(FaceContact, GradientAndHessianAreThoseOfTheValue) {
  int touched = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3 at = random.vector(0.009);
    const Pose X_WG =
        upright(at.x(), at.y(), 1.7e-4) * poseFromXyzRpy(Vec3::Zero(), random.vector(0.02));
    block.place(tool(), X_WG);
    // Off the plane, so that edges and corners are met as well.
    const Points x = block.mesh.points + random.points(block.mesh.numPoints(), 1e-4);
    Points g = Points::Zero(3, x.cols());
    EXPECT_DOUBLE_EQ(block.potential.addGradient(x, &g), block.potential.value(x));
    if (g.norm() == 0.0) continue;
    ++touched;
    std::vector<std::pair<int, int>> pairs;
    for (Eigen::Index e = 0; e < block.mesh.numTets(); ++e) {
      for (int a = 0; a < 4; ++a) {
        for (int b = 0; b < a; ++b)
          pairs.emplace_back(block.mesh.tets(a, e), block.mesh.tets(b, e));
      }
    }
    fem::Stiffness K(fem::BlockMatrix(static_cast<int>(x.cols()), pairs));
    block.potential.addHessian(x, fem::Tangent::kExact, &K);
    const Points d = random.points(x.cols(), 1.0);
    constexpr double h = 1e-8;
    const double slope =
        (block.potential.value(x + h * d) - block.potential.value(x - h * d)) / (2.0 * h);
    EXPECT_NEAR(g.cwiseProduct(d).sum(), slope, 1e-4 * g.norm() * d.norm());
    Points Kd, plus = Points::Zero(3, x.cols()), minus = plus;
    K.multiply(d, &Kd);
    block.potential.addGradient(x + h * d, &plus);
    block.potential.addGradient(x - h * d, &minus);
    EXPECT_LT((Kd - (plus - minus) / (2.0 * h)).norm(), 1e-3 * Kd.norm()) << tool().name;
  }
  EXPECT_GE(touched, 15);
}

// Sliding over edges and corners changes the energy by no more than the force along the way.
TEST_P(FaceContact, EnergyHasNoJumpsAlongASlide) {
  double last = 0.0, most = 0.0, largest = 0.0;
  for (int i = 0; i <= 4000; ++i) {
    const double s = i / 4000.0;
    block.place(tool(), upright(-0.012 + 0.024 * s, -0.008 + 0.017 * s, 2e-4));
    const double energy = block.potential.value(block.mesh.points);
    if (i > 0) most = std::max(most, std::abs(energy - last));
    largest = std::max(largest, energy);
    last = energy;
  }
  EXPECT_GT(largest, 0.0);
  EXPECT_LT(most, 0.06 * largest) << tool().name;
}

// A ball that got behind a face brings it back, over an edge as within a triangle; it never
// pulls the surface after it.
TEST_P(FaceContact, BringsBackWhatIsBehind) {
  for (const double x : {0.003, 0.0, 1e-5}) {
    block.place(tool(), upright(x, 0.0, 1.2e-3));
    const Vec3 force = block.forceOnTissue();
    EXPECT_LT(force.z(), -1e-2) << tool().name << " at " << x;
  }
}

// A lower face that is driven through the upper one comes nearer to a tool that hovers over both.
TEST_P(FaceContact, EnergyHasNoJumpsWhereTheSurfaceCrossesItself) {
  const Pose X_WG = upright(0.003, 0.001, -0.03);
  block.potential.setObstacles({{&tool().geometry, 0, X_WG, X_WG}});
  block.potential.findCandidates(block.mesh.points, {0.1});
  Points d = Points::Zero(3, block.mesh.numPoints());
  for (Eigen::Index i = 0; i < d.cols(); ++i) {
    if (block.mesh.points(2, i) < -0.0199) d(2, i) = 1.0;
  }
  test::expectNoJumps(block.potential, block.mesh.points, d, 1e-4, 360);
}

INSTANTIATE_TEST_SUITE_P(All, FaceContact, ::testing::Range(0, 5));

// A ball that is behind goes on to triangles of other sizes, and of stiffer tissue.
TEST(FaceContact, EnergyHasNoJumpsBehindTheSurface) {
  test::Random random;
  Block soft("augmented_lagrangian");
  const Eigen::Index n = soft.mesh.numPoints();
  soft.mesh.points += random.points(n, 1.5e-3);
  const Eigen::VectorXd bearing = Eigen::VectorXd::LinSpaced(n, 1e4, 1e6);
  soft.potential.setBearing(Points::Ones(3, n), Eigen::VectorXd::Ones(n), bearing);
  const Tool tip{"tip", Sphere{2e-4}, -2e-4};
  for (int trial = 0; trial < 5; ++trial) {
    const Vec3 at = random.vector(0.004);
    soft.place(tip, poseFromXyzRpy(Vec3(at.x(), at.y(), -4e-3), Vec3::Zero()));
    ASSERT_LT(soft.forceOnTissue().z(), 0.0);
    Points d = Points::Zero(3, n);
    d.row(0).setConstant(std::cos(trial));
    d.row(1).setConstant(std::sin(trial));
    test::expectNoJumps(soft.potential, soft.mesh.points, d, 4e-6, 1500);
  }
}

TEST(FaceContact, IsNotAskedForWhereSamplesAreCloseEnough) {
  Block block;
  const Tool rod{"rod", Capsule{8e-3, 0.03}, -0.038};
  block.place(rod, poseFromXyzRpy(Vec3(0.003, 0.001, 0.038), Vec3::Zero()));
  std::vector<Contact> contacts;
  block.potential.setObstacles({{&rod.geometry, 0, poseFromXyzRpy(Vec3(0, 0, 0.037), Vec3::Zero()),
                                 poseFromXyzRpy(Vec3(0, 0, 0.037), Vec3::Zero())}});
  block.potential.collect(block.mesh.points, &contacts);
  ASSERT_FALSE(contacts.empty());
  for (const Contact& c : contacts) EXPECT_GE(c.touch.sample, 0);
}

}  // namespace
}  // namespace palpate::contact::face_contact_test

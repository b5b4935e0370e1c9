// SPDX-License-Identifier: GPL-3.0-or-later
// Nested meshes of 10-node tetrahedra.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "crooked_block.h"
#include "support/contains.h"

namespace palpate::mesh::nested_quadratic_mesh_test {
namespace {

using test::crookedBlock;
using test::linearField;
using test::near;
using test::volumeOf;

constexpr double kFinest = 0.004;  // [m]

// Middle nodes among the corners, as a file may have them.
TetMesh shuffled(const TetMesh& mesh) {
  std::vector<int> number(static_cast<std::size_t>(mesh.numPoints()));
  for (std::size_t i = 0; i < number.size(); ++i) number[i] = static_cast<int>(i);
  std::shuffle(number.begin(), number.end(), std::mt19937(8));
  TetMesh other = mesh;
  const auto renamed = [&](int i) { return number[static_cast<std::size_t>(i)]; };
  for (int i = 0; i < mesh.numPoints(); ++i) other.points.col(renamed(i)) = mesh.points.col(i);
  other.tets = mesh.tets.unaryExpr(renamed);
  other.midnodes = mesh.midnodes.unaryExpr(renamed);
  return other;
}

Points quadraticField(const Points& X) {
  Points field = linearField(X);
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    const Vec3 p = X.col(i);
    field(0, i) += 9.0 * p.x() * p.y() - 4.0 * p.z() * p.z();
    field(1, i) += 7.0 * p.x() * p.x() + 5.0 * p.y() * p.z();
    field(2, i) += 6.0 * p.y() * p.y() - 8.0 * p.x() * p.z();
  }
  return field;
}

LumpedMasses lumpedMasses(const TetMesh& mesh) {
  LumpedMasses masses{Eigen::VectorXd::Zero(mesh.numPoints()), Eigen::MatrixXd(10, mesh.numTets())};
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    const double mass = 1000.0 * signedVolume(mesh.points, mesh.tets.col(t));
    masses.shares.col(t).head(4).setConstant(mass / 36.0);
    masses.shares.col(t).tail(6).setConstant(mass * 4.0 / 27.0);
    for (int k = 0; k < 4; ++k) masses.points[mesh.tets(k, t)] += masses.shares(k, t);
    for (int k = 0; k < 6; ++k) masses.points[mesh.midnodes(k, t)] += masses.shares(4 + k, t);
  }
  return masses;
}

void expectStraightAndNumbered(const NestedMesh& nested) {
  const TetMesh& mesh = nested.mesh();
  ASSERT_TRUE(mesh.quadratic());
  TetMesh corners = mesh;
  corners.midnodes.resize(6, 0);
  corners.points.conservativeResize(3, corners.tets.maxCoeff() + 1);
  const TetMesh expected = toQuadratic(corners);
  EXPECT_EQ(mesh.points, expected.points);
  EXPECT_EQ(mesh.midnodes, expected.midnodes);
  EXPECT_EQ(nested.surface(), trianglesOf(boundaryFaces(mesh)));
}

TEST(NestedQuadraticMesh, IsTheLinearOneWithMiddleNodes) {
  const TetMesh coarse = shuffled(toQuadratic(crookedBlock()));
  NestedMesh nested(coarse), linear(crookedBlock());
  expectStraightAndNumbered(nested);
  for (int i = 0; i < nested.mesh().numPoints(); ++i) {
    ASSERT_GE(nested.coarsePoint(i), 0);
    EXPECT_LT((nested.mesh().points.col(i) - coarse.points.col(nested.coarsePoint(i))).norm(),
              1e-16);
  }
  const Vec3 p(0.05, 0.04, 0.06);
  ASSERT_TRUE(nested.adapt(nested.mesh().points, near(p, kFinest), {}));
  linear.adapt(linear.mesh().points, near(p, kFinest), {});
  expectStraightAndNumbered(nested);
  EXPECT_EQ(nested.bisected(), linear.bisected());
  EXPECT_EQ(nested.mesh().tets, linear.mesh().tets);
  EXPECT_NEAR(volumeOf(nested.mesh()), volumeOf(coarse), 1e-12 * volumeOf(coarse));
  for (const MeshChange::Middle& m : nested.middles()) {
    const auto& X = nested.mesh().points;
    EXPECT_LT((X.col(m.point) - 0.5 * (X.col(m.a) + X.col(m.b))).norm(), 1e-16);
  }
  test::expectRestored(nested, coarse);
}

// Also where cells that are there no more are forgotten.
TEST(NestedQuadraticMesh, DependsOnWhatIsAskedForNotOnThePast) {
  const TetMesh coarse = toQuadratic(crookedBlock());
  NestedMesh direct(coarse), travelled(coarse);
  NestedMesh::Limits limits;
  limits.join_below = 1.0;  // no hysteresis
  for (int k = 0; k < 12; ++k) {
    const Vec3 p(0.02 + 0.08 * (k % 2), 0.02 + 0.005 * k, 0.06 * (k % 3) / 2.0);
    travelled.adapt(travelled.mesh().points, near(p, kFinest), limits);
  }
  const Vec3 end(0.1, 0.04, 0.06);
  travelled.adapt(travelled.mesh().points, near(end, kFinest), limits);
  direct.adapt(direct.mesh().points, near(end, kFinest), limits);
  EXPECT_EQ(travelled.mesh().points, direct.mesh().points);
  EXPECT_EQ(travelled.mesh().midnodes, direct.mesh().midnodes);
  EXPECT_EQ(travelled.surface(), direct.surface());
}

TEST(NestedQuadraticMesh, TellsHowFieldsAreCarriedOver) {
  NestedMesh nested(toQuadratic(crookedBlock()));
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 1.0);
  bool split = false, joined = false;
  for (double x : {0.02, 0.05, 0.08}) {
    const TetMesh old = nested.mesh();
    const auto change = nested.adapt(old.points, near(Vec3(x, 0.04, 0.06), kFinest), {});
    ASSERT_TRUE(change);
    const TetMesh& now = nested.mesh();
    ASSERT_EQ(change->num_old_points, old.numPoints());
    ASSERT_EQ(change->numNewPoints(), now.numPoints());
    split |= !change->inside.empty();

    const Points field = quadraticField(old.points), carried = change->interpolate(field);
    EXPECT_LT((carried - quadraticField(now.points)).cwiseAbs().maxCoeff(), 1e-15);
    for (int i = 0; i < now.numPoints(); ++i) {
      if (change->old_point[i] < 0) continue;
      EXPECT_EQ(carried.col(i), field.col(change->old_point[i]));
      EXPECT_EQ(now.points.col(i), old.points.col(change->old_point[i]));
    }

    const LumpedMasses m = lumpedMasses(old), M = lumpedMasses(now);
    const Points linear = change->transport(linearField(old.points), m, M);
    EXPECT_LT((linear - linearField(now.points)).cwiseAbs().maxCoeff(), 1e-15);
    Points wild(3, old.numPoints());
    for (double& value : wild.reshaped()) value = noise(random);
    for (const Points& v : {wild, field}) {
      const Vec3 before = v * m.points, after = change->transport(v, m, M) * M.points;
      EXPECT_LT((before - after).norm(), 1e-14 * (v.cwiseAbs() * m.points).norm());
    }
    // What is corrected is not nothing.
    EXPECT_GT((wild * m.points - change->interpolate(wild) * M.points).norm(),
              1e-3 * (wild * m.points).norm());
    for (const MeshChange::Range& from : change->tets) joined |= from.last - from.first > 1;
  }
  EXPECT_TRUE(split && joined);
}

// Velocities where nothing changes stay what they are.
TEST(NestedQuadraticMesh, CorrectsVelocitiesOnlyWhereTheMeshChanges) {
  NestedMesh nested(toQuadratic(crookedBlock()));
  const TetMesh old = nested.mesh();
  const auto change = nested.adapt(old.points, near(Vec3(0.1, 0.08, 0.06), kFinest), {});
  const Points field = quadraticField(old.points);
  const Points carried = change->transport(field, lumpedMasses(old), lumpedMasses(nested.mesh()));
  const Points expected = quadraticField(nested.mesh().points);
  int kept = 0;
  for (int i = 0; i < nested.mesh().numPoints(); ++i) {
    kept += change->old_point[i] >= 0 && carried.col(i) == field.col(change->old_point[i]);
  }
  EXPECT_GT(kept, old.numPoints() / 3);
  EXPECT_LT((carried - expected).cwiseAbs().maxCoeff(), 1e-3);  // of 0.1
}

// Corners alone would not show it.
TEST(NestedQuadraticMesh, IsNotJoinedWhereThatWouldInvertTetrahedra) {
  const TetMesh coarse = toQuadratic(crookedBlock());
  const auto num_corners = crookedBlock().numPoints();
  for (const double shift : {0.0, 0.012}) {
    NestedMesh nested(coarse);
    const auto fine = [](const Vec3&) { return 0.009; };
    ASSERT_TRUE(nested.adapt(nested.mesh().points, fine, {}));
    Points x = nested.mesh().points;
    for (int i = 0; i < x.cols(); ++i) {
      if (nested.coarsePoint(i) >= num_corners) x(0, i) += shift * (i % 2 == 0 ? 1.0 : -1.0);
    }
    const bool changed = nested.adapt(x, [](const Vec3&) { return 1.0; }, {}) != nullptr;
    EXPECT_TRUE(changed);
    EXPECT_EQ(nested.isCoarse(), shift == 0.0);
  }
}

TEST(NestedQuadraticMesh, RefusesBentEdges) {
  TetMesh mesh = toQuadratic(crookedBlock());
  EXPECT_EQ(firstBentTet(mesh), -1);
  mesh.points.col(mesh.midnodes(2, 17)) += Vec3(0.0, 1e-9, 0.0);
  EXPECT_GE(firstBentTet(mesh), 0);
  EXPECT_LE(firstBentTet(mesh), 17);
  try {
    NestedMesh nested(mesh);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(test::contains(error.what(), "has a bent edge"));
    EXPECT_TRUE(test::contains(error.what(), "use 4-node tetrahedra"));
  }
}

}  // namespace
}  // namespace palpate::mesh::nested_quadratic_mesh_test

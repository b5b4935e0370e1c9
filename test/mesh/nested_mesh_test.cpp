// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/nested_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "crooked_block.h"
#include "palpate/mesh/quality.h"
#include "palpate/mesh/size_estimate.h"

namespace palpate::mesh::nested_mesh_test {
namespace {

using test::crookedBlock;
using test::linearField;
using test::near;
using test::volumeOf;

LumpedMasses lumpedMasses(const TetMesh& mesh) {
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(mesh.numPoints());
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    const double share = 250.0 * signedVolume(mesh.points, mesh.tets.col(t));
    for (int i : mesh.tets.col(t)) masses[i] += share;
  }
  return {masses, {}};
}

std::set<std::set<int>> faces(const Eigen::Matrix3Xi& triangles) {
  std::set<std::set<int>> all;
  for (Eigen::Index i = 0; i < triangles.cols(); ++i) {
    all.insert({triangles(0, i), triangles(1, i), triangles(2, i)});
  }
  return all;
}

double areaOf(const Points& X, const Eigen::Matrix3Xi& triangles) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < triangles.cols(); ++i) {
    const Vec3 a = X.col(triangles(0, i));
    sum += 0.5 * (X.col(triangles(1, i)) - a).cross(X.col(triangles(2, i)) - a).norm();
  }
  return sum;
}

// Of a tetrahedron, short ones first [m].
std::vector<double> edgesOf(const TetMesh& mesh, Eigen::Index tet) {
  std::vector<double> lengths;
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < a; ++b) {
      const int i = mesh.tets(a, tet), j = mesh.tets(b, tet);
      lengths.push_back((mesh.points.col(i) - mesh.points.col(j)).norm());
    }
  }
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

void expectConforming(const NestedMesh& nested, double volume, double area) {
  const TetMesh& mesh = nested.mesh();
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    ASSERT_GT(signedVolume(mesh.points, mesh.tets.col(t)), 0.0) << t;
  }
  EXPECT_NEAR(volumeOf(mesh), volume, 1e-12 * volume);
  // A point that hangs on a face would leave that face, and its parts, on the boundary.
  EXPECT_EQ(faces(nested.surface()), faces(boundaryTriangles(mesh.tets)));
  EXPECT_NEAR(areaOf(mesh.points, nested.surface()), area, 1e-12 * area);
}

TEST(NestedMesh, BeginsAsTheCoarseMesh) {
  const TetMesh coarse = crookedBlock();
  const NestedMesh nested(coarse);
  ASSERT_EQ(nested.mesh().numTets(), coarse.numTets());
  ASSERT_EQ(nested.mesh().numPoints(), coarse.numPoints());
  for (Eigen::Index t = 0; t < coarse.numTets(); ++t) {
    EXPECT_EQ(nested.coarseTets()[t], t);
    std::set<int> corners(coarse.tets.col(t).begin(), coarse.tets.col(t).end());
    for (int i : nested.mesh().tets.col(t)) EXPECT_EQ(corners.count(nested.coarsePoint(i)), 1u);
  }
  for (Eigen::Index i = 0; i < coarse.numPoints(); ++i) {
    EXPECT_EQ(nested.mesh().points.col(i),
              coarse.points.col(nested.coarsePoint(static_cast<int>(i))));
  }
  EXPECT_NEAR(areaOf(nested.mesh().points, nested.surface()),
              areaOf(coarse.points, boundaryTriangles(coarse.tets)), 1e-15);
}

TEST(NestedMesh, IsFineWhereAskedForConformingAndOfGoodShape) {
  const TetMesh coarse = crookedBlock();
  const double volume = volumeOf(coarse);
  const double area = areaOf(coarse.points, boundaryTriangles(coarse.tets));
  NestedMesh nested(coarse);
  const Vec3 p(0.05, 0.04, 0.06);
  const NestedMesh::Size size = near(p, 0.002);
  ASSERT_TRUE(nested.adapt(nested.mesh().points, size, {}));
  expectConforming(nested, volume, area);
  const TetMesh& mesh = nested.mesh();
  double needed = 0.0;  // tetrahedra, if each had just the size that is wanted where it is
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    Vec3 middle = Vec3::Zero();
    for (int i : mesh.tets.col(t)) middle += 0.25 * mesh.points.col(i);
    EXPECT_LE(edgesOf(mesh, t).back(), 1.6 * size(middle) * (1.0 + 1e-12));
    const double length = edgeLength(signedVolume(mesh.points, mesh.tets.col(t)));
    needed += std::pow(length / size(middle), 3.0);
  }
  EXPECT_LT(static_cast<double>(mesh.numTets()),
            3.0 * needed + static_cast<double>(coarse.numTets()));
  // A bounded number of shapes: fine ones are not much worse than coarse ones.
  const TetQuality before = measureQuality(coarse), after = measureQuality(mesh);
  EXPECT_GT(after.min_dihedral_deg, 0.4 * before.min_dihedral_deg);
  EXPECT_GT(after.median_dihedral_deg, 0.8 * before.median_dihedral_deg);
  NestedMesh finer(coarse);
  ASSERT_TRUE(finer.adapt(finer.mesh().points, near(p, 0.0005), {}));
  EXPECT_GT(measureQuality(finer.mesh()).min_dihedral_deg, 0.9 * after.min_dihedral_deg);
}

TEST(NestedMesh, HasEdgesThatAreInTheMeanAsLongAsAskedFor) {
  for (double h : {0.004, 0.005, 0.006, 0.008}) {
    NestedMesh nested(crookedBlock());
    ASSERT_TRUE(nested.adapt(nested.mesh().points, [=](const Vec3&) { return h; }, {}));
    double sum = 0.0;
    for (Eigen::Index t = 0; t < nested.mesh().numTets(); ++t) {
      for (double length : edgesOf(nested.mesh(), t)) sum += length / 6.0;
    }
    EXPECT_NEAR(sum / static_cast<double>(nested.mesh().numTets()), h, 0.1 * h);
  }
}

TEST(NestedMesh, DependsOnWhatIsAskedForNotOnThePast) {
  const TetMesh coarse = crookedBlock();
  NestedMesh direct(coarse), travelled(coarse);
  NestedMesh::Limits limits;
  limits.join_below = 1.0;  // no hysteresis
  for (double x = 0.02; x < 0.1; x += 0.01) {
    const Vec3 p(x, 0.04, 0.06);
    travelled.adapt(linearField(travelled.mesh().points), near(linearField(p), 0.003), limits);
  }
  const Vec3 end(0.1, 0.04, 0.06);
  travelled.adapt(travelled.mesh().points, near(end, 0.003), limits);
  direct.adapt(direct.mesh().points, near(end, 0.003), limits);
  EXPECT_EQ(travelled.mesh().points, direct.mesh().points);
  EXPECT_EQ(travelled.mesh().tets, direct.mesh().tets);
  EXPECT_EQ(travelled.surface(), direct.surface());
  EXPECT_EQ(travelled.bisected(), direct.bisected());
  test::expectRestored(travelled, coarse);
}

TEST(NestedMesh, DoesNotGoToAndFro) {
  NestedMesh nested(crookedBlock());
  const Vec3 p(0.05, 0.04, 0.06);
  ASSERT_TRUE(nested.adapt(nested.mesh().points, near(p, 0.003), {}));
  EXPECT_FALSE(nested.adapt(nested.mesh().points, near(p, 0.003), {}));
  EXPECT_FALSE(nested.adapt(nested.mesh().points, near(p, 0.0036), {}));
  EXPECT_TRUE(nested.adapt(nested.mesh().points, near(p, 0.006), {}));
}

TEST(NestedMesh, SpreadsWorkOverSeveralChanges) {
  const TetMesh coarse = crookedBlock();
  const double volume = volumeOf(coarse);
  const double area = areaOf(coarse.points, boundaryTriangles(coarse.tets));
  NestedMesh at_once(coarse), in_parts(coarse);
  const NestedMesh::Size size = near(Vec3(0.05, 0.04, 0.06), 0.003);
  at_once.adapt(at_once.mesh().points, size, {});
  NestedMesh::Limits limits;
  limits.max_bisections = 100;
  int changes = 0;
  for (; in_parts.adapt(in_parts.mesh().points, size, limits); ++changes) {
    expectConforming(in_parts, volume, area);
    ASSERT_LT(changes, 100);
  }
  EXPECT_GT(changes, 5);
  EXPECT_EQ(in_parts.mesh().tets, at_once.mesh().tets);
}

TEST(NestedMesh, TellsHowFieldsAreCarriedOver) {
  NestedMesh nested(crookedBlock());
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 1.0);
  bool split = false, joined = false;
  for (double x : {0.02, 0.05, 0.08}) {
    const TetMesh old = nested.mesh();
    const auto change = nested.adapt(old.points, near(Vec3(x, 0.04, 0.06), 0.003), {});
    ASSERT_TRUE(change);
    const TetMesh& now = nested.mesh();
    split |= !change->added.empty();
    joined |= !change->removed.empty();
    ASSERT_EQ(change->num_old_points, old.numPoints());
    ASSERT_EQ(change->numNewPoints(), now.numPoints());

    const Points linear = change->interpolate(linearField(old.points));
    EXPECT_LT((linear - linearField(now.points)).cwiseAbs().maxCoeff(), 1e-15);
    const LumpedMasses m = lumpedMasses(old), M = lumpedMasses(now);
    const Points carried = change->transport(linearField(old.points), m, M);
    EXPECT_LT((carried - linearField(now.points)).cwiseAbs().maxCoeff(), 1e-14);

    Points wild(3, old.numPoints());
    for (double& value : wild.reshaped()) value = noise(random);
    const Vec3 before = wild * m.points, after = change->transport(wild, m, M) * M.points;
    EXPECT_LT((before - after).norm(), 1e-14 * (wild.cwiseAbs() * m.points).norm());

    ASSERT_EQ(static_cast<Eigen::Index>(change->tets.size()), now.numTets());
    for (Eigen::Index t = 0; t < now.numTets(); ++t) {
      const auto [first, last] = change->tets[t];
      ASSERT_LT(first, last);
      double parts = 0.0;
      for (int k = first; k < last; ++k) parts += signedVolume(old.points, old.tets.col(k));
      const double volume = signedVolume(now.points, now.tets.col(t));
      if (last - first > 1) {
        EXPECT_NEAR(parts, volume, 1e-12 * volume);
      } else {
        EXPECT_LE(volume, parts * (1.0 + 1e-12));
      }
    }
  }
  EXPECT_TRUE(split && joined);
}

TEST(NestedMesh, RefusesBitsOfAnotherMesh) {
  NestedMesh nested(crookedBlock());
  nested.adapt(nested.mesh().points, near(Vec3(0.05, 0.04, 0.06), 0.004), {});
  const std::string bits = nested.bisected();
  const Eigen::Matrix4Xi tets = nested.mesh().tets;
  EXPECT_THROW(nested.restore(bits + "0"), std::invalid_argument);
  EXPECT_THROW(nested.restore(bits.substr(1)), std::invalid_argument);
  std::string hanging(static_cast<std::size_t>(crookedBlock().numTets()), '0');
  hanging.replace(0, 1, "100");
  EXPECT_THROW(nested.restore(hanging), std::invalid_argument);
  EXPECT_EQ(nested.mesh().tets, tets);
}

}  // namespace
}  // namespace palpate::mesh::nested_mesh_test

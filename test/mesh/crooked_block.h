// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "palpate/mesh/nested_mesh.h"

namespace palpate::test {

/// A block whose tetrahedra are all of different shapes.
inline mesh::TetMesh crookedBlock() {
  mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.12, 0.1, 0.06), {6, 5, 3});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.003, 0.003);
  for (Eigen::Index i = 0; i < mesh.points.size(); ++i) mesh.points.data()[i] += shift(random);
  return mesh;
}

inline mesh::NestedMesh::Size near(const Vec3& p, double finest) {
  return [=](const Vec3& at) { return finest + 0.3 * std::max(0.0, (at - p).norm() - 0.008); };
}

inline Points linearField(const Points& X) {
  Mat3 A;
  A << 1.0, 0.2, -0.3, 0.1, 0.8, 0.4, 0.0, -0.5, 1.3;
  return (A * X).colwise() + Vec3(0.01, -0.02, 0.03);
}

inline double volumeOf(const mesh::TetMesh& mesh) {
  double sum = 0.0;
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    sum += mesh::signedVolume(mesh.points, mesh.tets.col(t));
  }
  return sum;
}

/// The bits of `nested`, which came of `coarse`, make the same mesh of it, and that the coarse one.
inline void expectRestored(const mesh::NestedMesh& nested, const mesh::TetMesh& coarse) {
  mesh::NestedMesh restored(coarse);
  restored.restore(nested.bisected());
  EXPECT_EQ(restored.mesh().points, nested.mesh().points);
  EXPECT_EQ(restored.mesh().tets, nested.mesh().tets);
  EXPECT_EQ(restored.mesh().midnodes, nested.mesh().midnodes);
  restored.coarsen();
  EXPECT_EQ(restored.mesh().tets, mesh::NestedMesh(coarse).mesh().tets);
  EXPECT_EQ(restored.mesh().midnodes, mesh::NestedMesh(coarse).mesh().midnodes);
}

}  // namespace palpate::test

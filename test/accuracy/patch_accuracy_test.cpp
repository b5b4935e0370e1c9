// SPDX-License-Identifier: GPL-3.0-or-later
// The patch test and rigid motion of every element, on a mesh of which no two elements are alike;
// the worst over all laws.
#include <gtest/gtest.h>

#include <algorithm>

#include "palpate/fem/elasticity.h"
#include "support/accuracy_record.h"
#include "support/random.h"

namespace palpate {
namespace {

bool inside(const Vec3& X) { return (X.array() > 1e-9).all() && (X.array() < 1.0 - 1e-9).all(); }

mesh::TetMesh distorted(const std::string& element) {
  test::Random random;
  mesh::TetMesh mesh = mesh::boxMesh(Vec3::Ones(), Eigen::Vector3i::Constant(3));
  for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
    if (inside(mesh.points.col(i))) mesh.points.col(i) += random.vector(0.05);
  }
  return fem::meshFor(element, mesh);
}

fem::Composition solidOf(const std::string& law, const mesh::TetMesh& mesh) {
  fem::Composition solid =
      fem::Composition::uniform(material::makeMaterial(law, material::exampleConstants(law)));
  if (material::needsFibres(solid.solids[0].law)) {
    solid.frames.assign(mesh.numTets(), test::Random(7).rotation());
  }
  return solid;
}

// 1e-16 for each of some hundred operations at a node, and a thousand times that where a law's
// volumetric part, so much stiffer, cancels.
constexpr double kRounding = 1e-11;

class Patch : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Elements, Patch, ::testing::ValuesIn(fem::elementNames()),
                         [](const auto& element) { return element.param; });

// Unbalanced forces inside, relative to all forces, under a homogeneous deformation.
TEST_P(Patch, IsPassed) {
  const mesh::TetMesh mesh = distorted(GetParam());
  const Mat3 F = Mat3::Identity() + test::Random(3).matrix(0.1);
  double worst = 0.0;
  for (const std::string& law : material::materialNames()) {
    Points g;
    fem::makeElasticity(GetParam(), mesh, solidOf(law, mesh))->gradient(F * mesh.points, &g);
    for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
      if (inside(mesh.points.col(i))) worst = std::max(worst, g.col(i).norm() / g.norm());
    }
  }
  test::recordAccuracy({"Patch test and rigid motion", "162 distorted tetrahedra, straight edges",
                        GetParam(), "unbalanced force inside, worst of all laws", worst, 0.0,
                        "theory: zero", worst, kRounding});
}

// Forces after a turn of 90 degrees and a shift, relative to those of a strain of one.
TEST_P(Patch, RigidMotionIsFree) {
  const mesh::TetMesh mesh = distorted(GetParam());
  const Mat3 R = Eigen::AngleAxisd(M_PI / 2, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  double worst = 0.0;
  for (const std::string& law : material::materialNames()) {
    if (law == "linear") continue;  // is for small rotations
    const auto body = fem::makeElasticity(GetParam(), mesh, solidOf(law, mesh));
    Points g, stretched;
    body->gradient((R * mesh.points).colwise() + Vec3(3, -2, 1), &g);
    body->gradient(1.01 * mesh.points, &stretched);
    worst = std::max(worst, 0.01 * g.norm() / stretched.norm());
  }
  test::recordAccuracy({"Patch test and rigid motion", "162 distorted tetrahedra, straight edges",
                        GetParam(), "force after a turn of 90 degrees, worst of all laws", worst,
                        0.0, "theory: zero", worst, kRounding});
}

}  // namespace
}  // namespace palpate

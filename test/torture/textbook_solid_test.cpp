// SPDX-License-Identifier: GPL-3.0-or-later
// What looks at solvers from outside has the forces and masses that the elements have.
#include "torture/textbook_solid.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "palpate/fem/elasticity.h"

namespace palpate::torture::textbook_solid_test {
namespace {

struct Body {
  std::string element, law;
};

class TextbookSolids : public ::testing::TestWithParam<Body> {};

material::Material lawOf(const std::string& name, double times) {
  if (name == "holzapfel_ogden") {
    return material::makeMaterial(name, {{"a", {500.0 * times}},
                                         {"b", {1.0}},
                                         {"af", {1500.0 * times}},
                                         {"bf", {1.5}},
                                         {"as", {400.0 * times}},
                                         {"bs", {1.2}},
                                         {"afs", {200.0 * times}},
                                         {"bfs", {1.1}},
                                         {"poisson_ratio", {0.45}}});
  }
  return material::makeMaterial(name,
                                {{"young_modulus", {5e3 * times}}, {"poisson_ratio", {0.45}}});
}

TEST_P(TextbookSolids, HaveTheForcesAndMassesOfTheElements) {
  const mesh::TetMesh mesh =
      fem::meshFor(GetParam().element, mesh::boxMesh(Vec3(0.04, 0.03, 0.02), {3, 2, 2}));
  const Mat3 frame = Eigen::Quaterniond(0.8, 0.3, -0.4, 0.5).normalized().toRotationMatrix();
  constexpr double kDensity = 1060.0;
  const std::vector<material::Material> laws{lawOf(GetParam().law, 1.0),
                                             lawOf(GetParam().law, 1e3)};
  fem::Composition composition;
  for (const material::Material& law : laws) composition.solids.push_back({law, kDensity, {}});
  mesh::CellMesh rest = mesh::cellsOf(mesh);
  for (Eigen::Index e = 0; e < rest.numCells(); ++e) {
    const bool stiff = rest.points(2, rest.cells(0, e)) + rest.points(2, rest.cells(3, e)) > 0.02;
    composition.solid_of.push_back(stiff ? 1 : 0);
  }
  rest.solid = composition.solid_of;
  composition.frames.assign(static_cast<std::size_t>(rest.numCells()), frame);
  const auto elasticity = fem::makeElasticity(GetParam().element, mesh, composition);
  const TextbookSolid textbook(rest, GetParam().element, laws, kDensity, frame);

  Points x = mesh.points;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    for (int k = 0; k < 3; ++k) {
      x(k, i) += 4e-4 * std::sin(300.0 * x(k, i) + 200.0 * x((k + 1) % 3, i) + 7.0 * k);
    }
  }
  Points g = Points::Zero(3, x.cols());
  elasticity->gradient(x, &g);
  ASSERT_GT(g.norm(), 1e-2);
  EXPECT_LT((textbook.elasticForces(x) + g).norm(), 1e-10 * g.norm());
  EXPECT_LT((textbook.masses() - elasticity->masses()).norm(), 1e-12 * textbook.masses().norm());
  EXPECT_NEAR(textbook.loaded().sum(), textbook.masses().sum(), 1e-12);
}

std::vector<Body> bodies() {
  std::vector<Body> all;
  for (const std::string& element : fem::elementNames()) {
    for (const char* law :
         {"neo_hookean", "corotational", "st_venant_kirchhoff", "holzapfel_ogden"}) {
      all.push_back({element, law});
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Of, TextbookSolids, ::testing::ValuesIn(bodies()),
                         [](const auto& i) { return i.param.element + "_" + i.param.law; });

}  // namespace
}  // namespace palpate::torture::textbook_solid_test

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/fem/elasticity.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/solver/potential.h"
#include "support/random.h"

namespace palpate::test {

// Of a held, bent block of quadratic elements, whose upper half is `ratio` times as stiff.
struct HalfStiffBlock {
  fem::Stiffness A;
  Points b;

  HalfStiffBlock(double ratio, double poisson_ratio) {
    Random random;
    const mesh::TetMesh mesh =
        fem::meshFor("tet10", mesh::boxMesh(Vec3(0.1, 0.1, 0.1), Eigen::Vector3i(2, 2, 2)));
    const auto solid = [&](double young_modulus) {
      return material::Solid{
          material::makeMaterial("stable_neo_hookean", {{"young_modulus", {young_modulus}},
                                                        {"poisson_ratio", {poisson_ratio}}}),
          1000.0,
          {}};
    };
    fem::Composition solids{{solid(5e3), solid(5e3 * ratio)}, {}, {}};
    for (Eigen::Index t = 0; t < mesh.tets.cols(); ++t) {
      solids.solid_of.push_back(mesh.points(2, mesh.tets(0, t)) < 0.05 ? 0 : 1);
    }
    const auto body = fem::makeElasticity("tet10", mesh, solids);
    A = body->makeMatrix();
    body->hessian(mesh.points + random.points(mesh.numPoints(), 1e-5), fem::Tangent::kProjected,
                  &A);
    fem::FreeMask free = fem::FreeMask::Ones(3, mesh.numPoints());
    for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
      if (mesh.points(2, i) == 0.0) free.col(i).setZero();
    }
    A.constrain(free);
    b = random.points(mesh.numPoints(), 1.0).cwiseProduct(free);
  }
  double residual(const Points& x) const {
    Points Ax;
    A.multiply(x, &Ax);
    return (b - Ax).norm() / b.norm();
  }
};
inline const HalfStiffBlock& mild() {
  static const HalfStiffBlock system(1.0, 0.45);
  return system;
}
inline const HalfStiffBlock& hard() {
  static const HalfStiffBlock system(1e6, 0.4999);
  return system;
}

}  // namespace palpate::test

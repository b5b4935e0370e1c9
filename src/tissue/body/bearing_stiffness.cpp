// SPDX-License-Identifier: GPL-3.0-or-later
#include "bearing_stiffness.h"

#include <algorithm>

namespace palpate::tissue {
namespace {

double youngModulus(const material::Solid& solid) {
  const material::Moduli m = material::moduli(solid.law);
  return 9.0 * m.kappa * m.mu / (3.0 * m.kappa + m.mu);
}

// Mean edge length at each node; mid-edge nodes have that of their triangle.
Eigen::VectorXd youngModuli(const mesh::TetMesh& mesh, const Eigen::Matrix3Xi& triangles,
                            const fem::Composition& composition) {
  Eigen::VectorXd E = Eigen::VectorXd::Zero(mesh.numPoints());
  for (Eigen::Index t = 0; t < mesh.tets.cols(); ++t) {
    const double of_tet = youngModulus(composition.solid(static_cast<int>(t)));
    for (int i : mesh.tets.col(t)) E[i] = std::max(E[i], of_tet);
  }
  for (const auto& triangle : triangles.colwise()) {
    const double stiffest = E(triangle).maxCoeff();
    for (int i : triangle) {
      if (E[i] == 0.0) E[i] = stiffest;
    }
  }
  return E;
}

}  // namespace

Eigen::VectorXd bearingStiffness(const mesh::TetMesh& mesh, const Eigen::Matrix3Xi& triangles,
                                 const fem::Composition& composition) {
  Eigen::VectorXd lengths = Eigen::VectorXd::Zero(mesh.numPoints());
  Eigen::VectorXd edges = lengths;
  for (const auto& triangle : triangles.colwise()) {
    for (int k = 0; k < 3; ++k) {
      const int i = triangle[k], j = triangle[(k + 1) % 3];
      const double length = (mesh.points.col(i) - mesh.points.col(j)).norm();
      for (int end : {i, j}) {
        lengths[end] += length;
        edges[end] += 1.0;
      }
    }
  }
  const Eigen::VectorXd E = youngModuli(mesh, triangles, composition);
  return (edges.array() > 0.0)
      .select(E.array() * edges.array() / lengths.array().max(1e-300), 0.0)
      .matrix();
}

}  // namespace palpate::tissue

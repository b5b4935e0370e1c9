// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "palpate/enrichment/deformations.h"
#include "palpate/mesh/surface_levels.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/mesh/used_points.h"

namespace palpate::test {

/// A body's surface, coarse and split once, with a round dent about every third point of its top,
/// that no body need have.
inline enrichment::DeformationDatabase dentedBlock(const mesh::TetMesh& body) {
  enrichment::DeformationDatabase database;
  database.coarse =
      mesh::onlyUsedPoints({body.points, mesh::trianglesOf(mesh::boundaryFaces(body))});
  database.fine = mesh::splitTriangles(database.coarse);
  const double top = database.coarse.points.row(2).maxCoeff();
  for (int contact = 0; contact < database.numCoarse(); contact += 3) {
    const Vec3 middle = database.coarse.points.col(contact);
    if (middle.z() < top - 1e-9) continue;
    enrichment::Deformation sample{contact, Vec3(0, 0, -1), Points::Zero(3, database.numFine())};
    for (Eigen::Index i = 0; i < database.numFine(); ++i) {
      const double r = (database.fine.points.col(i) - middle).norm() / 0.015;
      sample.fine(2, i) = -0.004 * std::exp(-r * r);
    }
    database.samples.push_back(sample);
  }
  return database;
}

}  // namespace palpate::test

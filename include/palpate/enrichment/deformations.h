// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::enrichment {

/// How a surface deforms under a press at one of its coarse points.
struct Deformation {
  int contact = 0;  ///< Coarse point.
  Vec3 force;       ///< [N]
  Points fine;      ///< Displacements, 3 x n [m]; of the coarse points the first columns.
};

/// Deformations of a body that is known by a fine surface, whose first points are those of a coarse
/// one.
struct DeformationDatabase {
  mesh::SurfaceMesh coarse, fine;  ///< At rest [m].
  std::vector<Deformation> samples;
  std::string made_by;  ///< What DatabaseFolder was told.

  Eigen::Index numCoarse() const { return coarse.points.cols(); }
  Eigen::Index numFine() const { return fine.points.cols(); }
};

}  // namespace palpate::enrichment

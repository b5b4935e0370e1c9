// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::enrichment {

/// Deformation of a surface under a press at a coarse point.
struct Deformation {
  int contact = 0;  ///< Index of the coarse point.
  Vec3 force;       ///< [N]
  Points fine;      ///< Displacements, 3 x n [m]; the first columns are those of the coarse points.
};

/// Deformations of a body by its fine surface, whose first points are those of the coarse surface.
struct DeformationDatabase {
  mesh::SurfaceMesh coarse, fine;  ///< At rest [m].
  std::vector<Deformation> samples;
  std::string made_by;  ///< Request text of DatabaseFolder.

  Eigen::Index numCoarse() const { return coarse.points.cols(); }
  Eigen::Index numFine() const { return fine.points.cols(); }
};

}  // namespace palpate::enrichment

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/base/types.h"

namespace palpate::mesh {

/// Triangles in space; nothing is promised of closedness or orientation (see surface_check.h).
struct SurfaceMesh {
  Points points;               ///< 3 x n [m] (or the file's unit until scaled).
  Eigen::Matrix3Xi triangles;  ///< Corner indices, 3 x m; counter-clockwise seen from outside.
};

/// Volume inside a closed, outward oriented surface [m^3], by the divergence theorem.
double enclosedVolume(const SurfaceMesh& surface);

}  // namespace palpate::mesh

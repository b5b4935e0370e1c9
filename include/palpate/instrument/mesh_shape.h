// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "palpate/instrument/geometry.h"
#include "palpate/mesh/distance_grid.h"

namespace palpate::instrument {

/// What becomes of a mesh that is not convex.
struct MeshShapeSettings : mesh::DistanceGridSettings {
  bool convex_hull = false;  ///< Its hull, which fills its notches and holes; else it is sampled.
};

/// What is being done, and a part in [0, 1].
using ShapeProgress = std::function<void(const std::string& what, double part)>;

struct MeshShape {
  Geometry geometry;
  std::string note;                  ///< How it was sampled, or that it was filled; for the user.
  std::vector<std::string> repairs;  ///< What was mended, a sentence each.
};

/// A mesh whose convex hull reaches beyond it by less than this part of its diagonal is convex.
constexpr double kConvexWithin = 1.0e-3;

/// How far the hull of the surface's points reaches beyond the surface [m]: the depth below the
/// hull of points on the triangles, a fiftieth of the diagonal apart.
double depthBelowHull(const mesh::SurfaceMesh& surface, const ConvexHull& hull);

/// The shape of a triangle mesh [m]: exactly its hull if it is convex; else a sampled surface, out
/// of the user's cache where it is there, or the hull if the settings ask for it.
/// @throws std::invalid_argument that says what is wrong and what to do if the mesh has no volume,
/// or is neither convex nor, repaired as an organ's surface is, closed. `file` is named by errors.
MeshShape shapeOfMesh(const mesh::SurfaceMesh& surface, const std::string& file,
                      const MeshShapeSettings& settings, const ShapeProgress& progress = {});

}  // namespace palpate::instrument

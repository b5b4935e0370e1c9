// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "palpate/instrument/geometry.h"
#include "palpate/mesh/distance_grid.h"

namespace palpate::instrument {

/// Treatment of meshes that are not convex.
struct MeshShapeSettings : mesh::DistanceGridSettings {
  bool convex_hull = false;  ///< Use the convex hull, which fills notches and holes; else sample.
};

/// Reports the present task and its progress in [0, 1].
using ShapeProgress = std::function<void(const std::string& what, double part)>;

struct MeshShape {
  Geometry geometry;
  std::string note;                  ///< How it was sampled or filled, for the user.
  std::vector<std::string> repairs;  ///< Repairs, a sentence each.
};

/// Largest depth below the hull, over the diagonal, of a convex mesh [-].
constexpr double kConvexWithin = 1.0e-3;

/// Largest depth of the surface below the hull of its points [m], at points on the triangles a
/// fiftieth of the diagonal apart.
double depthBelowHull(const mesh::SurfaceMesh& surface, const ConvexHull& hull);

/// Shape of a triangle mesh [m]: the exact hull if it is convex; else the hull if the settings ask
/// for it, or a sampled surface, from the user's cache if present. Errors name `file`.
/// @throws std::invalid_argument, with cause and remedy, for a mesh without volume, or neither
/// convex nor closed after the repairs of an organ's surface.
MeshShape shapeOfMesh(const mesh::SurfaceMesh& surface, const std::string& file,
                      const MeshShapeSettings& settings, const ShapeProgress& progress = {});

}  // namespace palpate::instrument

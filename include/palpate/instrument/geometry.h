// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "palpate/base/types.h"
#include "palpate/mesh/distance_grid.h"
#include "palpate/mesh/surface_mesh.h"

namespace palpate::instrument {

/// Centre at the origin.
struct Sphere {
  double radius;  ///< [m]
};
/// The axis is the segment from z = -half_length to +half_length on the z axis.
struct Capsule {
  double radius;       ///< [m]
  double half_length;  ///< [m], without the caps.
};
/// The axis is z, with flat ends at z = -half_length and +half_length.
struct Cylinder {
  double radius;       ///< [m]
  double half_length;  ///< [m]
};
struct Box {
  Vec3 half_extents;  ///< [m]
};
/// A closed convex polyhedron, outward oriented, with its face planes n . p <= d.
struct ConvexHull {
  mesh::SurfaceMesh surface;
  Eigen::Matrix3Xd normals;  ///< Unit, outward, one per triangle, 3 x m.
  Eigen::VectorXd offsets;   ///< d of each plane [m], m.
};

/// A closed surface by its sampled distance. Copies share it.
struct SampledSurface {
  std::shared_ptr<const mesh::DistanceGrid> grid;
};

using Geometry = std::variant<Sphere, Capsule, Cylinder, Box, ConvexHull, SampledSurface>;

/// A collision shape of a link. `X_LG` maps the shape's frame to the link's frame.
struct CollisionBody {
  int link;          ///< Index into Instrument::linkNames().
  std::string name;  ///< "link" or "link/collision name", for reports.
  Pose X_LG;
  Geometry geometry;
};

}  // namespace palpate::instrument

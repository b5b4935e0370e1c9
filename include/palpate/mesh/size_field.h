// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <variant>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/mesh/selection.h"
#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh {

/// The straight lines from each point to the next [m]; of a single point that point.
struct Polyline {
  std::vector<Vec3> points;
};
/// The surface of the body itself.
struct OwnSurface {};

/// Where a mesh is to be fine.
struct RefinementZone {
  double finest = 0.0;  ///< Mean edge there [m], > 0.
  double growth = 0.3;  ///< What an edge grows by for each metre farther away [-], in (0, 1].
  double radius = 0.0;  ///< As far from the place edges do not grow yet [m], >= 0.
  /// A plane's negative tolerance counts as 0 here.
  std::variant<Polyline, Region, OwnSurface> where;
};

/// How long edges are to be where:
///
///   h(p) = min(coarsest, min_i finest_i + growth_i max(0, dist_i(p) - radius_i)),
///
/// so that h(p) - h(q) is at most the largest growth times |p - q|, with dist_i from the nearest
/// point of place i.
struct SizeField {
  double coarsest = 0.0;             ///< Mean edge far from all places [m], > 0.
  std::vector<RefinementZone> near;  ///< Without any the edges are equally long everywhere.

  bool uniform() const { return near.empty(); }
};

/// The nearest point of the plane, box or ball: 0 inside [m].
double distanceTo(const Region& region, const Vec3& p);
/// The nearest of its points, of which there is at least one [m].
double distanceTo(const Polyline& line, const Vec3& p);

/// A surface that is asked for distances. Copies share it.
class SurfaceDistance {
 public:
  /// `surface` has a triangle.
  explicit SurfaceDistance(const SurfaceMesh& surface);

  /// The nearest point of the triangles [m].
  double operator()(const Vec3& p) const;
  /// Of a closed surface: whether a ray from `p` crosses it an odd number of times.
  bool contains(const Vec3& p) const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
};

/// A size field in a body.
class BodySizes {
 public:
  /// `surface`: of the body, for places near it.
  BodySizes(SizeField field, const SurfaceDistance& surface);

  /// h(p) [m]; with a `shift` [m] what it would be if all places were as much farther away.
  double at(const Vec3& p, double shift = 0.0) const;
  /// What place `i` alone asks for, which may be more than the coarsest.
  double ofZone(std::size_t i, const Vec3& p, double shift = 0.0) const;
  const SizeField& field() const { return field_; }

 private:
  SizeField field_;
  SurfaceDistance surface_;
};

}  // namespace palpate::mesh

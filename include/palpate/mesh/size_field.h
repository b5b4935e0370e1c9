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

/// A polyline [m], or a single point.
struct Polyline {
  std::vector<Vec3> points;
};
/// The body's surface.
struct OwnSurface {};

/// A refinement zone of a mesh.
struct RefinementZone {
  double finest = 0.0;  ///< Mean edge in the zone [m], > 0.
  double growth = 0.3;  ///< Growth of the edge by distance [-], in (0, 1].
  double radius = 0.0;  ///< Distance without growth [m], >= 0.
  /// A plane's negative tolerance counts as 0 here.
  std::variant<Polyline, Region, OwnSurface> where;
};

/// Mean edge length as a function of position:
///
///   h(p) = min(coarsest, min_i finest_i + growth_i max(0, dist_i(p) - radius_i)),
///
/// with the distance dist_i from zone i, so that |h(p) - h(q)| is at most the largest growth times
/// |p - q|.
struct SizeField {
  double coarsest = 0.0;             ///< Mean edge far from all zones [m], > 0.
  std::vector<RefinementZone> near;  ///< Zones; empty: uniform edges.

  bool uniform() const { return near.empty(); }
};

/// The nearest point of the plane, box or ball: 0 inside [m].
double distanceTo(const Region& region, const Vec3& p);
/// The nearest of its points, of which there is at least one [m].
double distanceTo(const Polyline& line, const Vec3& p);

/// Distance queries of a surface; copies share the data.
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
  /// `surface`: of the body, for zones at the surface.
  BodySizes(SizeField field, const SurfaceDistance& surface);

  /// h(p) [m]; `shift`: added to all distances [m].
  double at(const Vec3& p, double shift = 0.0) const;
  /// Edge length by zone `i` alone; may exceed the coarsest [m].
  double ofZone(std::size_t i, const Vec3& p, double shift = 0.0) const;
  const SizeField& field() const { return field_; }

 private:
  SizeField field_;
  SurfaceDistance surface_;
};

}  // namespace palpate::mesh

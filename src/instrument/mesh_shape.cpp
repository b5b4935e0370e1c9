// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/instrument/mesh_shape.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "palpate/base/error.h"
#include "palpate/instrument/convex_hull.h"
#include "palpate/mesh/convex_hull.h"
#include "palpate/mesh/distance_grid_cache.h"
#include "palpate/mesh/mesh_cache.h"
#include "palpate/mesh/surface_check.h"

namespace palpate::instrument {
namespace {

constexpr double kApart = 0.02;  // distance of points over the diagonal
constexpr int kMostDivisions = 50;

double diagonalOf(const mesh::SurfaceMesh& surface) {
  return (surface.points.rowwise().maxCoeff() - surface.points.rowwise().minCoeff()).norm();
}

std::string millimetres(double length) {
  std::ostringstream text;
  text << std::setprecision(2) << 1e3 * length << " mm";
  return text.str();
}

std::string noteOf(const mesh::DistanceGrid& grid, const MeshShapeSettings& settings) {
  const Eigen::Vector3i& cells = grid.field.box.cells;
  std::ostringstream text;
  text << "not convex: its distance is sampled, " << cells.x() << " x " << cells.y() << " x "
       << cells.z() << " cells of " << millimetres(grid.field.box.spacing) << " ("
       << std::setprecision(2) << 8e-6 * static_cast<double>(grid.field.coefficients.size())
       << " MB), off by " << millimetres(grid.largest_error) << " at most near the surface, rms "
       << millimetres(grid.rms_error);
  if (grid.limited) {
    text << "; that is more than the error of " << millimetres(settings.error)
         << " that is allowed: the memory that is allowed, " << settings.memory << " MB, is full";
  }
  return text.str();
}

mesh::SurfaceMesh repaired(const mesh::SurfaceMesh& surface, const std::string& file,
                           std::vector<std::string>* repairs) {
  try {
    mesh::SurfaceReport report;
    mesh::SurfaceMesh closed = mesh::repairSurface(surface, file, &report);
    *repairs = report.repairs;
    return closed;
  } catch (const InputError& error) {
    throw std::invalid_argument(
        std::string("it is not convex, and its inside is not known: ") + error.what() +
        "; mend it, part it into several that are convex, or have its convex hull taken "
        "(convex_hull: true)");
  }
}

}  // namespace

double depthBelowHull(const mesh::SurfaceMesh& surface, const ConvexHull& hull) {
  const double apart = kApart * diagonalOf(surface);
  double deepest = 0.0;
  for (Eigen::Index t = 0; t < surface.triangles.cols(); ++t) {
    const Vec3 a = surface.points.col(surface.triangles(0, t)),
               b = surface.points.col(surface.triangles(1, t)),
               c = surface.points.col(surface.triangles(2, t));
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const int n = std::clamp(static_cast<int>(std::ceil(longest / apart)), 2, kMostDivisions);
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        const Vec3 p = a + (b - a) * i / n + (c - a) * j / n;
        deepest = std::max(deepest, (hull.offsets - hull.normals.transpose() * p).minCoeff());
      }
    }
  }
  return deepest;
}

MeshShape shapeOfMesh(const mesh::SurfaceMesh& surface, const std::string& file,
                      const MeshShapeSettings& settings, const ShapeProgress& progress) {
  ConvexHull hull = makeConvexHull(mesh::convexHull(surface.points));
  const double depth = depthBelowHull(surface, hull);
  if (depth < kConvexWithin * diagonalOf(surface)) return {std::move(hull), "", {}};
  if (settings.convex_hull) {
    return {
        std::move(hull),
        "not convex, and filled up to its convex hull, which is " + millimetres(depth) + " from it",
        {}};
  }
  MeshShape shape;
  const mesh::SurfaceMesh closed = repaired(surface, file, &shape.repairs);
  auto grid = std::make_shared<const mesh::DistanceGrid>(
      mesh::distanceGridCached(closed, settings, mesh::defaultCacheDirectory(), progress));
  shape.note = noteOf(*grid, settings);
  shape.geometry = SampledSurface{std::move(grid)};
  return shape;
}

}  // namespace palpate::instrument

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/mesh/surface_mesh.h"

namespace palpate::formats {

/// Collects the points, polygons and problems of a file, for all formats alike.
class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(std::string file) : file_(std::move(file)) {}

  std::size_t numPoints() const { return points_.size(); }
  void addPoint(const Vec3& point) { points_.push_back(point); }

  /// Adds the polygon's fan; corners count from 0. Fewer than three corners, or one outside [first,
  /// end), is a problem at `where` ("line 12"; called only then).
  void addPolygon(const std::vector<std::int64_t>& corners, std::int64_t first, std::int64_t end,
                  const std::function<std::string()>& where);

  /// Merges points at equal positions into the first. n log n for any points; a hash table could be
  /// made slow by a file's choice of points.
  void mergePoints();

  /// @throws InputError with the first ten problems of the file, without triangles, or for a
  /// non-finite point.
  mesh::SurfaceMesh finish();

 private:
  std::string file_;
  std::vector<Vec3> points_;
  std::vector<Eigen::Vector3i> triangles_;
  std::vector<Problem> problems_;
  std::size_t num_problems_ = 0;

  void addProblem(Problem problem);
};

}  // namespace palpate::formats

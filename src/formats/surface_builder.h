// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/mesh/surface_mesh.h"

namespace palpate::formats {

/// Collects the points and polygons of a file and everything that is wrong with them, the same
/// way for every format.
class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(std::string file) : file_(std::move(file)) {}

  std::size_t numPoints() const { return points_.size(); }
  void addPoint(const Vec3& point) { points_.push_back(point); }

  /// The polygon's fan. Corners count from 0, whatever the file does. Fewer than three corners,
  /// or one outside `first` ... `end` - 1, is a problem at `where` ("line 12"; only called then).
  void addPolygon(const std::vector<std::int64_t>& corners, std::int64_t first, std::int64_t end,
                  const std::function<std::string()>& where);

  /// Of points in the same place the corners take the first. Takes n log n for any points, which a
  /// table of hashes would not: a file chooses them.
  void mergePoints();

  /// @throws InputError with the file's problems (the first ten of them), or if there is no
  /// triangle or a point is not finite.
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

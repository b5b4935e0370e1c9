// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_builder.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace palpate::formats {
namespace {

constexpr std::size_t kShownProblems = 10;

/// Drops unused points; the others keep their order.
void dropUnusedPoints(mesh::SurfaceMesh* surface) {
  std::vector<int> renamed(static_cast<std::size_t>(surface->points.cols()), -1);
  int* const corners = surface->triangles.data();
  int* const end = corners + surface->triangles.size();
  for (const int* c = corners; c != end; ++c) renamed[*c] = 0;
  int used = 0;
  for (Eigen::Index i = 0; i < surface->points.cols(); ++i) {
    if (renamed[i] < 0) continue;
    surface->points.col(used) = surface->points.col(i).eval();
    renamed[i] = used++;
  }
  surface->points.conservativeResize(3, used);
  for (int* c = corners; c != end; ++c) *c = renamed[*c];
}

}  // namespace

void SurfaceBuilder::addProblem(Problem problem) {
  if (++num_problems_ <= kShownProblems) problems_.push_back(std::move(problem));
}

void SurfaceBuilder::addPolygon(const std::vector<std::int64_t>& corners, std::int64_t first,
                                std::int64_t end, const std::function<std::string()>& where) {
  if (corners.size() < 3) {
    addProblem({where(), std::to_string(corners.size()) + " corners",
                "a face must have 3 corners or more"});
    return;
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] >= first && corners[i] < end) continue;
    addProblem(
        {where(), "corner " + std::to_string(i + 1),
         "the index is out of range; there are " + std::to_string(end - first) + " vertices"});
    return;
  }
  for (std::size_t i = 2; i < corners.size(); ++i) {
    triangles_.emplace_back(static_cast<int>(corners[0]), static_cast<int>(corners[i - 1]),
                            static_cast<int>(corners[i]));
  }
}

void SurfaceBuilder::mergePoints() {
  const auto before = [&](int a, int b) {
    const Vec3 &p = points_[a], &q = points_[b];
    if (p.x() != q.x()) return p.x() < q.x();
    if (p.y() != q.y()) return p.y() < q.y();
    return p.z() != q.z() ? p.z() < q.z() : a < b;
  };
  std::vector<int> order(points_.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), before);
  std::vector<int> first(points_.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && points_[order[k]] == points_[order[k - 1]];
    first[order[k]] = same ? first[order[k - 1]] : order[k];
  }
  for (Eigen::Vector3i& triangle : triangles_) {
    for (int c = 0; c < 3; ++c) triangle[c] = first[triangle[c]];
  }
}

mesh::SurfaceMesh SurfaceBuilder::finish() {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (points_[i].allFinite()) continue;
    addProblem({"vertex " + std::to_string(i + 1) + " (counted from 1)", "",
                "the coordinates must be finite"});
  }
  if (num_problems_ > kShownProblems) {
    problems_.push_back(
        {"", "", "and " + std::to_string(num_problems_ - kShownProblems) + " more problems"});
  }
  if (!problems_.empty()) throw InputError(file_, problems_);
  if (triangles_.empty()) throw InputError(file_, "", "", "there is no triangle in this file");
  if (points_.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw InputError(file_, "", "", "there are too many vertices in this file");
  }
  mesh::SurfaceMesh surface;
  surface.points.resize(3, static_cast<Eigen::Index>(points_.size()));
  for (std::size_t i = 0; i < points_.size(); ++i) surface.points.col(i) = points_[i];
  surface.triangles.resize(3, static_cast<Eigen::Index>(triangles_.size()));
  for (std::size_t i = 0; i < triangles_.size(); ++i) surface.triangles.col(i) = triangles_[i];
  dropUnusedPoints(&surface);
  return surface;
}

}  // namespace palpate::formats

// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_soup.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include "palpate/mesh/surface_check.h"

namespace palpate::mesh {
namespace {

bool repeatsCorner(const Eigen::Vector3i& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// The side opposite the middle corner of a flat triangle, which is the longest.
int longestSide(const SurfaceMesh& surface, const Eigen::Vector3i& t) {
  std::array<double, 3> length{};
  for (int s = 0; s < 3; ++s) {
    length[s] = (surface.points.col(t[(s + 1) % 3]) - surface.points.col(t[s])).squaredNorm();
  }
  return static_cast<int>(std::max_element(length.begin(), length.end()) - length.begin());
}

/// Removes a flat triangle with three different corners: splits a neighbour along the longest side
/// at the corner on that side. Returns false without such a neighbour.
bool splitNeighbour(SurfaceMesh* surface, Eigen::Index flat) {
  Eigen::Matrix3Xi& triangles = surface->triangles;
  const Eigen::Vector3i t = triangles.col(flat);
  const int side = longestSide(*surface, t);
  const int a = t[side], b = t[(side + 1) % 3], middle = t[(side + 2) % 3];
  for (Eigen::Index n = 0; n < triangles.cols(); ++n) {
    if (n == flat) continue;
    for (int s = 0; s < 3; ++s) {
      const int from = triangles(s, n), to = triangles((s + 1) % 3, n);
      if (!((from == a && to == b) || (from == b && to == a))) continue;
      const int apex = triangles((s + 2) % 3, n);
      if (apex == middle) continue;
      triangles.col(n) = Eigen::Vector3i(from, middle, apex);
      triangles.col(flat) = Eigen::Vector3i(middle, to, apex);
      return true;
    }
  }
  return false;
}

}  // namespace

int removeTriangles(SurfaceMesh* surface, const std::vector<bool>& drop) {
  Eigen::Index kept = 0;
  for (Eigen::Index t = 0; t < surface->triangles.cols(); ++t) {
    if (!drop[t]) surface->triangles.col(kept++) = surface->triangles.col(t).eval();
  }
  const auto removed = static_cast<int>(surface->triangles.cols() - kept);
  surface->triangles.conservativeResize(3, kept);
  return removed;
}

std::vector<int> firstInPlace(const Points& points) {
  std::vector<int> order(points.cols());
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](int i) {
    return std::make_tuple(points(0, i), points(1, i), points(2, i));
  };
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return place(i) < place(j); });
  std::vector<int> first(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && place(order[k]) == place(order[k - 1]);
    first[order[k]] = same ? first[order[k - 1]] : order[k];
  }
  return first;
}

bool isDegenerate(const SurfaceMesh& surface, Eigen::Index t) {
  const Eigen::Vector3i corners = surface.triangles.col(t);
  if (repeatsCorner(corners)) return true;
  const int side = longestSide(surface, corners);
  const Vec3 base = surface.points.col(corners[(side + 1) % 3]) - surface.points.col(corners[side]);
  const Vec3 other =
      surface.points.col(corners[(side + 2) % 3]) - surface.points.col(corners[side]);
  return base.cross(other).norm() <= kCollapsedTriangle * base.squaredNorm();
}

std::vector<bool> findDuplicateTriangles(const Eigen::Matrix3Xi& triangles) {
  std::vector<std::array<int, 4>> keys(triangles.cols());
  for (int t = 0; t < static_cast<int>(triangles.cols()); ++t) {
    keys[t] = {triangles(0, t), triangles(1, t), triangles(2, t), t};
    std::sort(keys[t].begin(), keys[t].begin() + 3);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<bool> duplicate(keys.size(), false);
  for (std::size_t k = 1; k < keys.size(); ++k) {
    duplicate[keys[k][3]] = std::equal(keys[k].begin(), keys[k].begin() + 3, keys[k - 1].begin());
  }
  return duplicate;
}

int mergePoints(SurfaceMesh* surface) {
  const std::vector<int> first = firstInPlace(surface->points);
  for (Eigen::Index t = 0; t < surface->triangles.cols(); ++t) {
    for (int c = 0; c < 3; ++c) surface->triangles(c, t) = first[surface->triangles(c, t)];
  }
  int merged = 0;
  for (std::size_t i = 0; i < first.size(); ++i) merged += first[i] != static_cast<int>(i);
  return merged;
}

int removeDegenerateTriangles(SurfaceMesh* surface) {
  std::vector<bool> drop(surface->triangles.cols());
  for (Eigen::Index t = 0; t < surface->triangles.cols(); ++t) {
    drop[t] = repeatsCorner(surface->triangles.col(t));
  }
  int removed = removeTriangles(surface, drop);
  // A split may leave smaller flat triangles, also before this one, so a few rounds are needed.
  constexpr int kRounds = 10;
  for (int round = 0, found = 1; round < kRounds && found > 0; ++round) {
    found = 0;
    for (Eigen::Index t = 0; t < surface->triangles.cols(); ++t) {
      if (isDegenerate(*surface, t) && splitNeighbour(surface, t)) ++found;
    }
    removed += found;
  }
  return removed;
}

int removeDuplicateTriangles(SurfaceMesh* surface) {
  return removeTriangles(surface, findDuplicateTriangles(surface->triangles));
}

int removeIsolatedPoints(SurfaceMesh* surface) {
  std::vector<int> renamed(surface->points.cols(), -1);
  for (Eigen::Index t = 0; t < surface->triangles.cols(); ++t) {
    for (int c = 0; c < 3; ++c) renamed[surface->triangles(c, t)] = 0;
  }
  int kept = 0;
  for (std::size_t i = 0; i < renamed.size(); ++i) {
    if (renamed[i] < 0) continue;
    surface->points.col(kept) = surface->points.col(i).eval();
    renamed[i] = kept++;
  }
  for (Eigen::Index t = 0; t < surface->triangles.cols(); ++t) {
    for (int c = 0; c < 3; ++c) surface->triangles(c, t) = renamed[surface->triangles(c, t)];
  }
  const auto removed = static_cast<int>(surface->points.cols()) - kept;
  surface->points.conservativeResize(3, kept);
  return removed;
}

}  // namespace palpate::mesh

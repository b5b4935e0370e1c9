// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/surface_check.h"

#include <algorithm>
#include <set>

#include "cgal/repair.h"
#include "surface_edges.h"
#include "surface_soup.h"

namespace palpate::mesh {
namespace {

int countTrue(const std::vector<bool>& flags) {
  return static_cast<int>(std::count(flags.begin(), flags.end(), true));
}

void countEdges(const std::vector<EdgeUse>& uses, SurfaceReport* report) {
  std::set<int> at_nonmanifold;
  forEachEdge(uses, [&](auto first, auto last) {
    const auto count = last - first;
    if (count == 1) ++report->boundary_edges;
    if (count == 2 && first->forward == (first + 1)->forward) ++report->misoriented_edges;
    if (count <= 2) return;
    ++report->nonmanifold_edges;
    for (auto use = first; use != last; ++use) at_nonmanifold.insert(use->triangle);
  });
  report->nonmanifold_triangles = static_cast<int>(at_nonmanifold.size());
}

int countComponents(const std::vector<EdgeUse>& uses, Eigen::Index triangles) {
  UnionFind pieces(triangles);
  forEachEdge(uses, [&](auto first, auto last) {
    for (auto use = first; use != last; ++use) pieces.join(first->triangle, use->triangle);
  });
  int count = 0;
  for (int t = 0; t < static_cast<int>(triangles); ++t) count += pieces.find(t) == t;
  return count;
}

/// Number of points whose triangles are not all connected by edges at the point.
int countSplitPoints(const std::vector<EdgeUse>& uses, const SurfaceMesh& surface) {
  const auto corner_at = [&](const EdgeUse& use, int point) {
    const int corner =
        surface.triangles(use.side, use.triangle) == point ? use.side : (use.side + 1) % 3;
    return 3 * use.triangle + corner;
  };
  UnionFind fans(3 * surface.triangles.cols());
  forEachEdge(uses, [&](auto first, auto last) {
    for (auto use = first; use != last; ++use) {
      fans.join(corner_at(*first, first->low), corner_at(*use, first->low));
      fans.join(corner_at(*first, first->high), corner_at(*use, first->high));
    }
  });
  std::vector<int> fans_at(surface.points.cols(), 0);
  for (int c = 0; c < static_cast<int>(surface.triangles.size()); ++c) {
    if (fans.find(c) == c) ++fans_at[surface.triangles(c % 3, c / 3)];
  }
  return static_cast<int>(
      std::count_if(fans_at.begin(), fans_at.end(), [](int n) { return n > 1; }));
}

}  // namespace

SurfaceReport checkSurface(const SurfaceMesh& surface) {
  SurfaceReport report;
  report.points = static_cast<int>(surface.points.cols());
  report.triangles = static_cast<int>(surface.triangles.cols());

  const std::vector<EdgeUse> uses = sortedEdges(surface.triangles);
  countEdges(uses, &report);
  report.components = countComponents(uses, surface.triangles.cols());
  report.nonmanifold_points = countSplitPoints(uses, surface);

  const std::vector<int> first = firstInPlace(surface.points);
  std::vector<bool> used(first.size(), false);
  for (Eigen::Index c = 0; c < surface.triangles.size(); ++c) {
    used[surface.triangles(c % 3, c / 3)] = true;
  }
  for (std::size_t i = 0; i < first.size(); ++i) {
    report.duplicate_points += first[i] != static_cast<int>(i);
  }
  report.isolated_points = report.points - countTrue(used);
  report.duplicate_triangles = countTrue(findDuplicateTriangles(surface.triangles));
  for (Eigen::Index t = 0; t < surface.triangles.cols(); ++t) {
    report.degenerate_triangles += isDegenerate(surface, t);
  }

  report.closed = report.triangles > 0 && report.boundary_edges == 0;
  report.manifold = report.nonmanifold_edges == 0 && report.nonmanifold_points == 0;
  report.oriented = report.closed && report.nonmanifold_edges == 0 &&
                    report.misoriented_edges == 0 && enclosedVolume(surface) > 0.0;
  if (report.manifold && report.misoriented_edges == 0) {
    report.self_intersecting_triangles = static_cast<int>(cgal::selfIntersections(surface).size());
  }
  return report;
}

}  // namespace palpate::mesh

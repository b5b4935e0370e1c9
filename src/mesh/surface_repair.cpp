// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Dense>
#include <algorithm>
#include <string>
#include <vector>

#include "cgal/repair.h"
#include "palpate/base/error.h"
#include "palpate/mesh/surface_check.h"
#include "surface_soup.h"

namespace palpate::mesh {
namespace {

void refuseUnusable(const SurfaceMesh& surface, const std::string& file) {
  if (surface.points.cols() == 0 || surface.triangles.cols() == 0) {
    throw InputError(file, "", "", "there is no triangle in the surface");
  }
  std::vector<Problem> problems;
  if (!surface.points.allFinite()) {
    problems.push_back({"points", "", "coordinates must be finite numbers"});
  }
  const auto n = static_cast<int>(surface.points.cols());
  if (surface.triangles.minCoeff() < 0 || surface.triangles.maxCoeff() >= n) {
    problems.push_back(
        {"triangles", "", "a corner is none of the " + std::to_string(n) + " points"});
  }
  if (!problems.empty()) throw InputError(file, problems);
}

class Repairs {
 public:
  /// `text` follows the count; "point" becomes "3 points".
  void add(const std::string& verb, int count, const std::string& noun,
           const std::string& rest = "") {
    if (count == 0) return;
    sentences_.push_back(verb + " " + std::to_string(count) + " " + noun + (count == 1 ? "" : "s") +
                         rest);
  }
  const std::vector<std::string>& sentences() const { return sentences_; }

 private:
  std::vector<std::string> sentences_;
};

Vec3 normal(const SurfaceMesh& surface, Eigen::Index t) {
  const Eigen::Vector3i c = surface.triangles.col(t);
  const Vec3 a = surface.points.col(c[0]);
  return (surface.points.col(c[1]) - a).cross(surface.points.col(c[2]) - a);
}

/// Number of triangles with reversed orientation; `after` begins with the triangles of `before`.
int countTurned(const SurfaceMesh& before, const SurfaceMesh& after) {
  int turned = 0;
  for (Eigen::Index t = 0; t < before.triangles.cols(); ++t) {
    turned += normal(before, t).dot(normal(after, t)) < 0.0;
  }
  return turned;
}

/// Triangles that intersect others, with `rings` of neighbours.
std::vector<bool> findCutting(const SurfaceMesh& surface, int rings) {
  std::vector<bool> found(surface.triangles.cols(), false);
  for (const int t : cgal::selfIntersections(surface)) found[t] = true;
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<bool> touched(surface.points.cols(), false);
    for (Eigen::Index c = 0; c < surface.triangles.size(); ++c) {
      if (found[c / 3]) touched[surface.triangles(c % 3, c / 3)] = true;
    }
    for (Eigen::Index c = 0; c < surface.triangles.size(); ++c) {
      if (touched[surface.triangles(c % 3, c / 3)]) found[c / 3] = true;
    }
  }
  return found;
}

std::string count(int n, const std::string& noun) {
  return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

/// Defects that prevent meshing of the present surface.
std::vector<Problem> listDefects(const SurfaceReport& report) {
  std::vector<Problem> problems;
  if (!report.closed) {
    problems.push_back({"", "",
                        "the surface is open: " + count(report.boundary_edges, "edge") +
                            " with one triangle only; holes this large are not filled"});
  }
  if (report.nonmanifold_edges > 0) {
    problems.push_back({"", "",
                        "the surface is not manifold: " + count(report.nonmanifold_edges, "edge") +
                            " with more than two triangles (" +
                            count(report.nonmanifold_triangles, "triangle") + ")"});
  }
  if (report.degenerate_triangles > 0) {
    problems.push_back(
        {"", "",
         count(report.degenerate_triangles, "triangle") + " without area could not be removed"});
  }
  if (report.self_intersecting_triangles > 0) {
    problems.push_back(
        {"", "",
         "the surface cuts itself: " + count(report.self_intersecting_triangles, "triangle") +
             " cut another one"});
  }
  return problems;
}

bool onlyCutsItself(const SurfaceReport& report) {
  return report.self_intersecting_triangles > 0 && report.closed && report.manifold &&
         report.degenerate_triangles == 0;
}

/// Replaces self-intersections by a patch. `before`: the input triangles in the order of `surface`;
/// removed ones are removed there, too.
void patchSelfIntersections(SurfaceMesh* surface, SurfaceMesh* before, SurfaceReport* found,
                            Repairs* repairs) {
  constexpr int kMaxRings = 2;
  for (int rings = 0; rings <= kMaxRings && onlyCutsItself(*found); ++rings) {
    std::vector<bool> cutting = findCutting(*surface, rings);
    SurfaceMesh patched = *surface;
    const int removed = removeTriangles(&patched, cutting);
    cgal::ClosingCounts counts;
    patched = cgal::orientAndClose(patched, kMaxCutShare, &counts);
    const SurfaceReport report = checkSurface(patched);
    if (!report.closed || !report.manifold || report.self_intersecting_triangles > 0) continue;
    repairs->add(
        "replaced", removed, "triangle",
        " that cut others, with neighbours, by " + count(counts.hole_triangles, "triangle"));
    cutting.resize(before->triangles.cols());
    removeTriangles(before, cutting);
    *surface = patched;
    *found = report;
  }
}

}  // namespace

SurfaceMesh repairSurface(const SurfaceMesh& surface, const std::string& file,
                          SurfaceReport* report) {
  refuseUnusable(surface, file);
  Repairs repairs;

  SurfaceMesh soup = surface;
  const int merged = mergePoints(&soup);
  repairs.add("merged", merged, "point", " with another in the same place");
  repairs.add("removed", removeDegenerateTriangles(&soup), "triangle", " without area");
  repairs.add("removed", removeDuplicateTriangles(&soup), "triangle", " that stood there twice");
  repairs.add("removed", removeIsolatedPoints(&soup) - merged, "point", " of no triangle");
  if (soup.triangles.cols() == 0) {
    throw InputError(file, "", "", "no triangle of the surface has an area");
  }
  SurfaceReport found = checkSurface(soup);
  if (found.nonmanifold_edges > 0) throw InputError(file, listDefects(found));

  SurfaceMesh mended = soup;
  if (!found.ok()) {
    cgal::ClosingCounts counts;
    mended = cgal::orientAndClose(soup, kMaxHoleShare, &counts);
    repairs.add("split", counts.split_points, "point", " where the surface touches itself");
    repairs.add("joined", counts.stitched_edges, "open edge");
    repairs.add("filled", counts.holes, "hole",
                " with " + count(counts.hole_triangles, "triangle"));
    found = checkSurface(mended);
    patchSelfIntersections(&mended, &soup, &found, &repairs);
    const std::vector<Problem> defects = listDefects(found);
    if (!defects.empty()) throw InputError(file, defects);
  }
  if (!found.oriented || found.components > 1) mended = cgal::orientOutward(mended);
  repairs.add("turned", countTurned(soup, mended), "triangle", " to face outward");

  if (report != nullptr) {
    *report = checkSurface(mended);
    report->repairs = repairs.sentences();
  }
  return mended;
}

}  // namespace palpate::mesh

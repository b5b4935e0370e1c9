// SPDX-License-Identifier: GPL-3.0-or-later
#include "organ_elements.h"

#include <cmath>
#include <sstream>

#include "palpate/base/error.h"
#include "palpate/base/number.h"
#include "palpate/mesh/cell_mesh.h"
#include "palpate/mesh/remesh.h"
#include "palpate/mesh/surface_check.h"
#include "palpate/scene/organ_assembly.h"

namespace palpate::scene {
namespace {

constexpr int kRemeshingRounds = 5, kRemeshings = 4;
constexpr double kMeanOff = 0.03;           // relative error of the mean edge
constexpr double kMostTriangles = 20000.0;  // ten times what bem solves for
// Relative loss of volume due to large triangles that is warned of, or refused.
constexpr double kMuchLost = 0.1, kMostLost = 0.5;

double areaOf(const mesh::SurfaceMesh& surface) {
  double area = 0.0;
  for (Eigen::Index t = 0; t < surface.triangles.cols(); ++t) {
    const Eigen::Vector3i v = surface.triangles.col(t);
    const Vec3 a = surface.points.col(v[0]);
    area += 0.5 * (surface.points.col(v[1]) - a).cross(surface.points.col(v[2]) - a).norm();
  }
  return area;
}

// Refuses early: remeshing to millions of triangles would take minutes.
void refuseTooMany(const mesh::SurfaceMesh& surface, const Scene& scene, const OrganConfig& organ,
                   const std::string& key) {
  const double length = organ.edge_length.coarsest;
  const double triangles = areaOf(surface) / (std::sqrt(3.0) / 4.0 * length * length);
  if (triangles <= kMostTriangles) return;
  std::ostringstream text;
  text << "would make about " << std::llround(triangles) << " triangles, more than "
       << kMostTriangles << "; must be at least " << length * std::sqrt(triangles / kMostTriangles)
       << " m for this body";
  throw InputError(scene.file, key + ".edge_length", formatNumber(length), text.str());
}

// Large triangles lose volume, since only their corners lie on the surface.
void checkElements(const mesh::SurfaceMesh& made, const mesh::SurfaceMesh& surface,
                   const Scene& scene, const OrganConfig& organ, const std::string& key,
                   std::vector<std::string>* warnings) {
  const double kept = mesh::enclosedVolume(made) / mesh::enclosedVolume(surface);
  const std::string length = formatNumber(organ.edge_length.coarsest);
  if (!mesh::checkSurface(made).ok() || !(kept >= 1.0 - kMostLost)) {
    throw InputError(scene.file, key + ".edge_length", length,
                     "triangles as large do not resolve the surface; must be smaller");
  }
  if (kept >= 1.0 - kMuchLost) return;
  warnings->push_back(scene.file + ": " + key + ".edge_length = " + length +
                      ": triangles as large enclose " + std::to_string(std::lround(100.0 * kept)) +
                      " % of the organ's volume");
}

}  // namespace

mesh::SurfaceMesh readOrganElements(const Scene& scene, const OrganConfig& organ,
                                    const std::string& key, std::vector<std::string>* warnings) {
  const mesh::SurfaceMesh surface = readOrganSurface(organ, scene.file, warnings);
  if (organ.surface.empty()) return surface;
  if (!organ.edge_length.uniform()) {
    throw InputError(scene.file, key + ".edge_length.near", "",
                     "model " + organ.model + " has edges of one length; leave it out");
  }
  refuseTooMany(surface, scene, organ, key);
  const double wanted = organ.edge_length.coarsest;
  // Halves the edge length first, to remove the influence of the file's triangles.
  const mesh::SurfaceMesh fine = mesh::remeshWithEdges(surface, 0.5 * wanted, kRemeshingRounds);
  mesh::SurfaceMesh made;
  double asked = wanted;  // remeshing gives edges shorter by 10 to 20 %
  for (int k = 0; k < kRemeshings; ++k) {
    made = mesh::remeshWithEdges(fine, asked, kRemeshingRounds);
    const double mean = mesh::meanEdgeLength({made.points, made.triangles, {}});
    if (std::abs(mean - wanted) < kMeanOff * wanted) break;
    asked *= wanted / mean;
  }
  checkElements(made, surface, scene, organ, key, warnings);
  return made;
}

}  // namespace palpate::scene

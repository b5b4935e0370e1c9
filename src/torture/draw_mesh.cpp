// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw_mesh.h"

#include <algorithm>
#include <cmath>

#include "palpate/organs/organs.h"

namespace palpate::torture {
namespace {

// Grid of cells with nearly equal edges, six tetrahedra each.
Eigen::Vector3i cellsOf(const Vec3& size, int tets) {
  const double cells = std::max(tets / 6.0, 8.0);
  const double edge = std::cbrt(size.prod() / cells);
  Eigen::Vector3i count;
  for (int c = 0; c < 3; ++c) {
    count[c] = std::max(2, static_cast<int>(std::lround(size[c] / edge)));
  }
  return count;
}

// Grades edges along x and y; `ratio` is the longest over the shortest.
void grade(double ratio, const Vec3& size, Points* points) {
  const double p = std::log(ratio);
  for (Eigen::Index i = 0; i < points->cols(); ++i) {
    for (int c = 0; c < 2; ++c) {
      const double s = (*points)(c, i) / size[c];
      (*points)(c, i) = size[c] * std::expm1(p * s) / std::expm1(p);
    }
  }
}

double leastDihedralOf(const Points& points, const Eigen::Matrix4Xi& tets) {
  double least = 90.0;
  for (Eigen::Index t = 0; t < tets.cols(); ++t) {
    least = std::min(least, leastDihedral(points, tets.col(t)));
  }
  return least;
}

// Deforms a box towards an ellipsoid by `part`, 1: completely. The bottom stays flat.
Points roundedBox(const Points& box, const Vec3& size, double part) {
  Points points = box;
  const Vec3 half(0.5 * size.x(), 0.5 * size.y(), size.z());
  for (Eigen::Index i = 0; i < box.cols(); ++i) {
    const Vec3 s = (box.col(i) - Vec3(half.x(), half.y(), 0.0)).cwiseQuotient(half);
    const double norm = s.norm();
    if (norm == 0.0) continue;
    const double shrink = 1.0 + part * (s.cwiseAbs().maxCoeff() / norm - 1.0);
    points.col(i) = shrink * s.cwiseProduct(half) + Vec3(half.x(), half.y(), 0.0);
  }
  return points;
}

void roundOff(mesh::TetMesh* mesh, const Vec3& size) {
  const Points box = mesh->points;
  for (const double part : {0.9, 0.7, 0.5, 0.3}) {
    mesh->points = roundedBox(box, size, part);
    if (leastDihedralOf(mesh->points, mesh->tets) >= 1.0) return;
  }
  mesh->points = box;
}

std::vector<std::vector<Eigen::Index>> tetsAround(const mesh::TetMesh& mesh) {
  std::vector<std::vector<Eigen::Index>> around(static_cast<std::size_t>(mesh.numPoints()));
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    for (int k = 0; k < 4; ++k) around[static_cast<std::size_t>(mesh.tets(k, t))].push_back(t);
  }
  return around;
}

// Moves one point in five towards the opposite face of one of its tetrahedra, while the dihedral
// angles around it stay above `least` [degrees].
void makeSlivers(double least, Draw* draw, mesh::TetMesh* mesh) {
  const auto around = tetsAround(*mesh);
  std::vector<bool> outer(static_cast<std::size_t>(mesh->numPoints()), false);
  const Eigen::Matrix3Xi faces = mesh::boundaryTriangles(mesh->tets);
  for (Eigen::Index f = 0; f < faces.size(); ++f) {
    outer[static_cast<std::size_t>(faces.data()[f])] = true;
  }
  for (std::size_t i = 0; i < around.size(); ++i) {
    if (outer[i] || !draw->chance(0.2)) continue;
    const Eigen::Vector4i tet = mesh->tets.col(draw->oneOf(around[i]));
    const Vec3 from = mesh->points.col(static_cast<Eigen::Index>(i));
    const Vec3 to = (mesh->points.col(tet[0]) + mesh->points.col(tet[1]) +
                     mesh->points.col(tet[2]) + mesh->points.col(tet[3]) - from) /
                    3.0;
    const auto angle = [&](double s) {
      mesh->points.col(static_cast<Eigen::Index>(i)) = from + s * (to - from);
      double smallest = 90.0;
      for (const Eigen::Index t : around[i]) {
        smallest = std::min(smallest, leastDihedral(mesh->points, mesh->tets.col(t)));
      }
      return smallest;
    };
    double good = 0.0, bad = 1.0;
    if (angle(0.0) < least) continue;
    for (int k = 0; k < 20; ++k) {
      const double middle = 0.5 * (good + bad);
      (angle(middle) >= least ? good : bad) = middle;
    }
    angle(good);
  }
}

}  // namespace

double leastDihedral(const Points& points, const Eigen::Vector4i& tet) {
  if (!(mesh::signedVolume(points, tet) > 0.0)) return 0.0;
  Vec3 normals[4];
  for (int k = 0; k < 4; ++k) {
    const Vec3 a = points.col(tet[(k + 1) & 3]), b = points.col(tet[(k + 2) & 3]),
               c = points.col(tet[(k + 3) & 3]);
    Vec3 n = (b - a).cross(c - a);
    if (n.dot(Vec3(points.col(tet[k])) - a) > 0.0) n = -n;
    normals[k] = n.normalized();
  }
  double least = 180.0;
  for (int k = 0; k < 4; ++k) {
    for (int j = 0; j < k; ++j) {
      const double between = std::acos(std::clamp(-normals[k].dot(normals[j]), -1.0, 1.0));
      least = std::min(least, between * 180.0 / static_cast<double>(EIGEN_PI));
    }
  }
  return least;
}

void drawMesh(const std::string& shape, int tets, Draw* draw, TortureOrgan* organ) {
  organ->shape = shape;
  organ->mesh = mesh::boxMesh(organ->size, cellsOf(organ->size, tets));
  if (shape == "graded") grade(draw->between(2.0, 20.0), organ->size, &organ->mesh.points);
  if (shape == "ball") roundOff(&organ->mesh, organ->size);
  if (shape == "sliver") makeSlivers(draw->decades(1.0, 10.0), draw, &organ->mesh);
  organ->min_dihedral = leastDihedralOf(organ->mesh.points, organ->mesh.tets);
  organ->mesh.points.colwise() += organ->low;
}

void drawGeneratedOrgan(Draw* draw, TortureOrgan* organ) {
  organ->shape = draw->chance(0.5) ? "kidney" : "gallbladder";
  organ->surface = organs::makeOrgan(organ->shape, 0.005);
  organ->edge_length = draw->between(0.006, 0.01);
  organ->low = organ->surface.points.rowwise().minCoeff();
  organ->size = Vec3(organ->surface.points.rowwise().maxCoeff()) - organ->low;
}

}  // namespace palpate::torture

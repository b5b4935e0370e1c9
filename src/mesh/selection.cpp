// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/selection.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/base/error.h"

namespace palpate::mesh {
namespace {

struct Inside {
  const Points& points;

  bool operator()(const PlaneRegion& plane, Eigen::Index i) const {
    return std::abs(points(plane.axis, i) - plane.at) <= plane.tolerance;
  }
  bool operator()(const BoxRegion& box, Eigen::Index i) const {
    return (points.col(i).array() >= box.min.array()).all() &&
           (points.col(i).array() <= box.max.array()).all();
  }
  bool operator()(const SphereRegion& sphere, Eigen::Index i) const {
    return (points.col(i) - sphere.center).norm() <= sphere.radius;
  }
  bool operator()(const HalfSpaceRegion& half, Eigen::Index i) const {
    return half.normal.dot(points.col(i) - half.point) >= 0.0;
  }
};

Region withTolerance(Region region, const Points& points) {
  auto* plane = std::get_if<PlaneRegion>(&region);
  if (plane && plane->tolerance < 0.0 && points.cols() > 0) {
    plane->tolerance = 1e-9 * (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
  }
  return region;
}

template <class Inside>
std::vector<int> indicesWhere(Eigen::Index n, Inside&& inside) {
  std::vector<int> selected;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (inside(i)) selected.push_back(static_cast<int>(i));
  }
  return selected;
}

std::string namesOf(const TetMesh& mesh) {
  std::vector<std::string> names;
  for (const auto& [name, values] : mesh.cell_data) names.push_back(name);
  return names.empty() ? "it has none" : "it has " + joinNames(names);
}

bool isWhole(double x) { return x == std::floor(x); }  // false for NaN

std::vector<int> selectByData(const TetMesh& mesh, const CellDataRegion& region) {
  const auto found = mesh.cell_data.find(region.name);
  if (found == mesh.cell_data.end()) {
    const bool tags = region.name.empty() || region.name == "region";
    if (!tags) {
      throw std::invalid_argument("the mesh file has no cell data " + region.name + "; " +
                                  namesOf(mesh));
    }
    if (mesh.region.empty()) {
      throw std::invalid_argument(
          "the mesh has no region tags (Gmsh's physical groups, Medit's references, VTK's cell "
          "data region or gmsh:physical)");
    }
    return indicesWhere(mesh.numTets(),
                        [&](Eigen::Index i) { return mesh.region[i] == region.value; });
  }
  const Eigen::MatrixXd& data = found->second;
  if (data.rows() != 1 || !std::all_of(data.data(), data.data() + data.size(), isWhole)) {
    throw std::invalid_argument("cell data " + region.name +
                                " must be one whole number a tetrahedron");
  }
  return indicesWhere(mesh.numTets(), [&](Eigen::Index i) { return data(0, i) == region.value; });
}

struct SelectTets {
  const TetMesh& mesh;

  std::vector<int> operator()(const CellDataRegion& region) const {
    return selectByData(mesh, region);
  }
  std::vector<int> operator()(const DepthRegion& region) const {
    const Eigen::VectorXd depth = surfaceDistances(mesh, tetCentroids(mesh));
    return indicesWhere(mesh.numTets(), [&](Eigen::Index i) {
      return depth[i] >= region.min && depth[i] <= region.max;
    });
  }
  template <class Shape>
  std::vector<int> operator()(const Shape& shape) const {
    const Points centroids = tetCentroids(mesh);
    return indicesWhere(mesh.numTets(),
                        [&](Eigen::Index i) { return Inside{centroids}(shape, i); });
  }
};

}  // namespace

Points tetCentroids(const TetMesh& mesh) {
  Points centroids(3, mesh.numTets());
  for (Eigen::Index e = 0; e < mesh.numTets(); ++e) {
    centroids.col(e) = 0.25 * (mesh.points.col(mesh.tets(0, e)) + mesh.points.col(mesh.tets(1, e)) +
                               mesh.points.col(mesh.tets(2, e)) + mesh.points.col(mesh.tets(3, e)));
  }
  return centroids;
}

std::vector<int> selectTets(const TetMesh& mesh, const TetRegion& region) {
  return std::visit(SelectTets{mesh}, region);
}

std::vector<int> selectPoints(const Points& points, const Region& region) {
  return std::visit(
      [&](const auto& r) {
        return indicesWhere(points.cols(), [&](Eigen::Index i) { return Inside{points}(r, i); });
      },
      withTolerance(region, points));
}

}  // namespace palpate::mesh

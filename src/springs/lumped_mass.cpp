// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/lumped_mass.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "palpate/mesh/surface_check.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::springs {
namespace {

// Adds 1/corners of `measure(cell)` to each corner. A cell of dimension d is degenerate if its
// measure is below mesh::kCollapsedTriangle times its longest side to the power d.
template <class Cells, class Measure>
Eigen::VectorXd shares(const Points& points, const Cells& cells, int dimension, const char* what,
                       const Measure& measure) {
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(points.cols());
  for (Eigen::Index i = 0; i < cells.cols(); ++i) {
    const auto cell = cells.col(i);
    const std::string name = std::string(what) + " " + std::to_string(i);
    if (cell.minCoeff() < 0 || cell.maxCoeff() >= points.cols()) {
      throw std::invalid_argument(name + ": a corner is none of the " +
                                  std::to_string(points.cols()) + " points");
    }
    double side = 0.0;
    for (Eigen::Index k = 0; k < cell.size(); ++k) {
      for (Eigen::Index l = 0; l < k; ++l) {
        side = std::max(side, (points.col(cell[k]) - points.col(cell[l])).norm());
      }
    }
    const double size = measure(cell);
    if (!(size > mesh::kCollapsedTriangle * std::pow(side, dimension))) {
      throw std::invalid_argument(name + ": is collapsed");
    }
    for (Eigen::Index k = 0; k < cell.size(); ++k) {
      shares[cell[k]] += size / static_cast<double>(cell.size());
    }
  }
  return shares;
}

double area(const Points& points, int a, int b, int c) {
  const Vec3 p = points.col(a), q = points.col(b), r = points.col(c);
  return 0.5 * (q - p).cross(r - p).norm();
}

}  // namespace

Eigen::VectorXd triangleShares(const Points& points, const Eigen::Matrix3Xi& triangles) {
  return shares(points, triangles, 2, "triangle",
                [&](const auto& t) { return area(points, t[0], t[1], t[2]); });
}

Eigen::VectorXd rectangleShares(const Points& points, const Eigen::Matrix4Xi& rectangles) {
  return shares(points, rectangles, 2, "rectangle", [&](const auto& r) {
    return area(points, r[0], r[1], r[2]) + area(points, r[0], r[2], r[3]);
  });
}

Eigen::VectorXd tetShares(const Points& points, const Eigen::Matrix4Xi& tets) {
  return shares(points, tets, 3, "tetrahedron",
                [&](const auto& t) { return std::abs(mesh::signedVolume(points, t)); });
}

}  // namespace palpate::springs

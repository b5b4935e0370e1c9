// SPDX-License-Identifier: GPL-3.0-or-later
#include "independent_forces.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "palpate/material/law.h"
#include "palpate/material/law_list.h"

namespace palpate::torture {
namespace {

Mat3 edgesOf(const Points& points, const Eigen::Vector4i& tet) {
  Mat3 D;
  for (int k = 0; k < 3; ++k) D.col(k) = points.col(tet[k + 1]) - points.col(tet[0]);
  return D;
}

}  // namespace

Points elasticForces(const mesh::CellMesh& rest, const Points& now,
                     const std::vector<const material::Material*>& law) {
  Points forces = Points::Zero(3, now.cols());
  for (Eigen::Index t = 0; t < rest.numCells(); ++t) {
    const Eigen::Vector4i tet = rest.cells.col(t);
    const Mat3 D = edgesOf(rest.points, tet), inverse = D.inverse();
    const Mat3 F = edgesOf(now, tet) * inverse;
    const Mat3 P =
        material::visitLaw([&](const auto& one) { return material::firstPiolaKirchhoff(one, F); },
                           *law[static_cast<std::size_t>(t)]);
    const Mat3 H = -D.determinant() / 6.0 * P * inverse.transpose();
    for (int k = 0; k < 3; ++k) {
      forces.col(tet[k + 1]) += H.col(k);
      forces.col(tet[0]) -= H.col(k);
    }
  }
  return forces;
}

Eigen::VectorXd lumpedMasses(const mesh::CellMesh& rest, double density) {
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(rest.numPoints());
  for (Eigen::Index t = 0; t < rest.numCells(); ++t) {
    const Eigen::Vector4i tet = rest.cells.col(t);
    const double quarter = 0.25 * density * mesh::signedVolume(rest.points, tet);
    for (int k = 0; k < 4; ++k) masses[tet[k]] += quarter;
  }
  return masses;
}

void addAtSurface(const tissue::Shape& shape, const sim::ContactPoint& point, Points* forces) {
  double nearest = std::numeric_limits<double>::infinity();
  Eigen::Vector3i corners = Eigen::Vector3i::Zero();
  Vec3 weights = Vec3::Zero();
  for (Eigen::Index t = 0; t < shape.triangles.cols(); ++t) {
    const Eigen::Vector3i tri = shape.triangles.col(t);
    Eigen::Matrix<double, 3, 2> D;
    const Vec3 a = shape.positions.col(tri[0]), p = point.p_W - a;
    D << Vec3(shape.positions.col(tri[1])) - a, Vec3(shape.positions.col(tri[2])) - a;
    const Eigen::Vector2d s = (D.transpose() * D).inverse() * (D.transpose() * p);
    const Vec3 w = Vec3(1.0 - s.sum(), s[0], s[1]).cwiseMax(0.0);
    const Vec3 inside = w / w.sum();
    const double off = (D * inside.tail<2>() - p).norm();
    if (!(off < nearest)) continue;
    nearest = off;
    corners = tri;
    weights = inside;
  }
  for (int k = 0; k < 3; ++k) forces->col(corners[k]) -= weights[k] * point.force_W;
}

}  // namespace palpate::torture

// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_operators.h"

#include <cmath>

#include "outer_rule.h"
#include "palpate/base/for_all.h"

namespace palpate::bem {
namespace {

// Averages A with its transpose; returns their distance over the norm.
double symmetrise(Eigen::MatrixXd* A) {
  double apart = 0.0, all = 0.0;
  for (Eigen::Index j = 0; j < A->cols(); ++j) {
    for (Eigen::Index i = 0; i < j; ++i) {
      const double a = (*A)(i, j), b = (*A)(j, i);
      apart += 2.0 * (a - b) * (a - b);
      all += a * a + b * b;
      (*A)(i, j) = (*A)(j, i) = 0.5 * (a + b);
    }
    all += (*A)(j, j) * (*A)(j, j);
  }
  return std::sqrt(apart / all);
}

}  // namespace

KelvinConstants::KelvinConstants(const material::Moduli& moduli) {
  const double nu =
      (3.0 * moduli.kappa - 2.0 * moduli.mu) / (2.0 * (3.0 * moduli.kappa + moduli.mu));
  factor = 1.0 / (16.0 * M_PI * moduli.mu * (1.0 - nu));
  isotropic = 3.0 - 4.0 * nu;
}

std::vector<Triangle> trianglesOf(const mesh::SurfaceMesh& surface) {
  std::vector<Triangle> triangles;
  for (const auto& corners : surface.triangles.colwise()) {
    Mat3 points;
    for (int a = 0; a < 3; ++a) points.col(a) = surface.points.col(corners[a]);
    triangles.emplace_back(points);
  }
  return triangles;
}

// Each column belongs to one test triangle, so threads write to disjoint memory.
SurfaceOperators surfaceOperators(const mesh::SurfaceMesh& surface,
                                  const std::vector<Triangle>& triangles,
                                  const material::Moduli& moduli, ThreadPool* pool) {
  const auto m = static_cast<Eigen::Index>(triangles.size());
  const KelvinConstants kelvin(moduli);
  SurfaceOperators made;
  made.single_layer.resize(3 * m, 3 * m);
  made.inverse.resize(m, m);
  Eigen::MatrixXd covers = Eigen::MatrixXd::Zero(surface.points.cols(), m);
  forAll(pool, triangles.size(), [&](std::size_t begin, std::size_t end) {
    for (auto i = static_cast<Eigen::Index>(begin); i < static_cast<Eigen::Index>(end); ++i) {
      const Triangle& over = triangles[static_cast<std::size_t>(i)];
      for (Eigen::Index j = 0; j < m; ++j) {
        const Triangle& source = triangles[static_cast<std::size_t>(j)];
        const OuterRule& rule = outerRule(over, source);
        double inverse = 0.0;
        Mat3 pull = Mat3::Zero();
        Vec3 cover = Vec3::Zero();
        for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
          const TrianglePotentials at = potentials(source, over.corners * rule.at.col(q));
          inverse += rule.weights[q] * at.inverse;
          pull += rule.weights[q] * at.pull;
          if (i != j) cover += rule.weights[q] * at.cover;
        }
        made.inverse(j, i) = over.area / (4.0 * M_PI) * inverse;
        made.single_layer.block<3, 3>(3 * j, 3 * i) =
            over.area * kelvin.factor * (kelvin.isotropic * inverse * Mat3::Identity() + pull);
        for (int a = 0; a < 3; ++a) {
          covers(surface.triangles(a, j), i) -= over.area / (4.0 * M_PI) * cover[a];
        }
      }
    }
  });
  made.double_layer = covers.transpose();
  made.skew = symmetrise(&made.single_layer);
  symmetrise(&made.inverse);
  return made;
}

}  // namespace palpate::bem

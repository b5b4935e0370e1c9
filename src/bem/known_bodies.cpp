// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/bem/known_bodies.h"

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "palpate/bem/surface_stiffness.h"
#include "palpate/mesh/cell_mesh.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/mesh/used_points.h"

namespace palpate::bem {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

double poissonRatio(const material::Moduli& m) {
  return (3.0 * m.kappa - 2.0 * m.mu) / (2.0 * (3.0 * m.kappa + m.mu));
}

// Nodal forces of a uniform inner stress, on the triangles from `first`.
Points forcesOf(const mesh::SurfaceMesh& surface, const Mat3& stress, Eigen::Index first = 0) {
  Points t = Points::Zero(3, surface.triangles.cols());
  for (Eigen::Index k = first; k < t.cols(); ++k) {
    const auto c = surface.triangles.col(k);
    const Vec3 u = surface.points.col(c[1]) - surface.points.col(c[0]);
    const Vec3 v = surface.points.col(c[2]) - surface.points.col(c[0]);
    t.col(k) = stress * u.cross(v).normalized();
  }
  return tractionForces(surface, t);
}

// Displacements under nodal forces; with `mirrors`, symmetry planes support the body.
Points solve(const mesh::SurfaceMesh& surface, const material::Moduli& moduli, const Points& forces,
             bool mirrors, ThreadPool* pool, KnownBody* made) {
  const SurfaceStiffness stiffness = surfaceStiffness(surface, moduli, pool);
  made->points = surface.points.cols();
  made->triangles = surface.triangles.cols();
  made->edge = mesh::meanEdgeLength({surface.points, surface.triangles, {}});
  made->skew = stiffness.skew;
  made->rigid = stiffness.rigid;
  const Eigen::Matrix3Xd free =
      mirrors ? Eigen::Matrix3Xd((surface.points.array() != 0.0).cast<double>())
              : Eigen::Matrix3Xd::Ones(3, surface.points.cols());
  const MatrixXd C = surfaceCompliance(stiffness.matrix, free, pool);
  const VectorXd u = C * Eigen::Map<const VectorXd>(forces.data(), forces.size());
  return Eigen::Map<const Points>(u.data(), 3, forces.cols());
}

double largest(const Points& u) { return u.colwise().norm().maxCoeff(); }

}  // namespace

mesh::SurfaceMesh sphere(int level, double radius, bool outward) {
  const double t = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vec3> points = {{-1, t, 0}, {1, t, 0}, {-1, -t, 0}, {1, -t, 0},
                              {0, -1, t}, {0, 1, t}, {0, -1, -t}, {0, 1, -t},
                              {t, 0, -1}, {t, 0, 1}, {-t, 0, -1}, {-t, 0, 1}};
  std::vector<Eigen::Vector3i> faces = {
      {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (; level > 0; --level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [at, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
      if (is_new) {
        points.push_back(points[static_cast<std::size_t>(a)].normalized() +
                         points[static_cast<std::size_t>(b)].normalized());
      }
      return at->second;
    };
    std::vector<Eigen::Vector3i> finer;
    for (const Eigen::Vector3i& f : faces) {
      const int a = middle(f[0], f[1]), b = middle(f[1], f[2]), c = middle(f[2], f[0]);
      finer.insert(finer.end(), {{f[0], a, c}, {f[1], b, a}, {f[2], c, b}, {a, b, c}});
    }
    faces = finer;
  }
  mesh::SurfaceMesh made;
  made.points.resize(3, static_cast<Eigen::Index>(points.size()));
  made.triangles.resize(3, static_cast<Eigen::Index>(faces.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    made.points.col(static_cast<Eigen::Index>(i)) = radius * points[i].normalized();
  }
  for (std::size_t k = 0; k < faces.size(); ++k) {
    made.triangles.col(static_cast<Eigen::Index>(k)) =
        outward ? faces[k] : Eigen::Vector3i(faces[k][0], faces[k][2], faces[k][1]);
  }
  return made;
}

KnownBody cubeInTension(const material::Moduli& moduli, int cells, ThreadPool* pool) {
  const mesh::TetMesh block = mesh::boxMesh(Vec3::Ones(), Eigen::Vector3i::Constant(cells));
  const mesh::SurfaceMesh cube =
      mesh::onlyUsedPoints({block.points, mesh::trianglesOf(mesh::boundaryFaces(block))});
  const Points f = forcesOf(cube, Vec3::UnitX().asDiagonal());
  KnownBody made;
  const Points u = solve(cube, moduli, f, true, pool, &made);
  const double nu = poissonRatio(moduli), E = 2.0 * moduli.mu * (1.0 + nu);
  const Points right = Vec3(1.0, -nu, -nu).asDiagonal() * cube.points / E;
  made.error = largest(u - right) / largest(right);
  return made;
}

KnownBody hollowSphere(const material::Moduli& m, int level, ThreadPool* pool) {
  const double b = 2.0, cube = b * b * b;
  const mesh::SurfaceMesh outer = sphere(level, b), inner = sphere(level, 1.0, false);
  const Eigen::Index n = outer.points.cols(), t = outer.triangles.cols();
  mesh::SurfaceMesh both{Points(3, 2 * n), Eigen::Matrix3Xi(3, 2 * t)};
  both.points << outer.points, inner.points;
  both.triangles << outer.triangles, inner.triangles.array() + static_cast<int>(n);
  KnownBody made;
  const Points u = solve(both, m, forcesOf(both, -Mat3::Identity(), t), true, pool, &made);
  const double A = 1.0 / (cube - 1.0) / (3.0 * m.kappa), B = cube / (cube - 1.0) / (4.0 * m.mu);
  Points right = both.points;
  for (Eigen::Index i = 0; i < right.cols(); ++i) {
    const double r = right.col(i).norm();
    right.col(i) *= A + B / (r * r * r);
  }
  made.error = largest(u - right) / largest(right);
  made.edge = mesh::meanEdgeLength({inner.points, inner.triangles, {}});
  return made;
}

KnownBody sphericalCavity(const material::Moduli& m, int level, ThreadPool* pool) {
  const double nu = poissonRatio(m), E = 2.0 * m.mu * (1.0 + nu);
  const double alpha = (1.0 + nu) / (3.0 * (1.0 - nu)),
               beta = 2.0 * (4.0 - 5.0 * nu) / (15.0 * (1.0 - nu));
  const Mat3 stress = Vec3::UnitZ().asDiagonal();
  const Mat3 far = Mat3(Vec3(-nu, -nu, 1.0).asDiagonal()) / E;
  const Mat3 volume = far.trace() / 3.0 * Mat3::Identity();
  const Mat3 near = volume / (1.0 - alpha) + (far - volume) / (1.0 - beta);
  const mesh::SurfaceMesh cavity = sphere(level, 1.0, false);
  KnownBody made;
  const Points u =
      solve(cavity, m, forcesOf(cavity, -stress), false, pool, &made) + far * cavity.points;
  const Points right = near * cavity.points;
  made.error = largest(u - right) / largest(right);
  // The stress of the strain that fits the points best.
  const Points& X = cavity.points;
  const Mat3 fit = u * X.transpose() * Mat3(X * X.transpose()).inverse();
  made.stress = E / (1.0 - nu * nu) * (fit(2, 2) + nu * 0.5 * (fit(0, 0) + fit(1, 1)));
  return made;
}

double cavityStress(double poisson_ratio) {
  return (27.0 - 15.0 * poisson_ratio) / (2.0 * (7.0 - 5.0 * poisson_ratio));
}

}  // namespace palpate::bem

// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/bem/plane_plate.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <vector>

namespace palpate::bem {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

// Constant-strain triangle of unit thickness: area B^T D B [Zienkiewicz, Taylor, Zhu 2005].
Eigen::Matrix<double, 6, 6> stiffness(const Eigen::Matrix<double, 2, 3>& x,
                                      const Eigen::Matrix3d& D) {
  const Eigen::Vector2d u = x.col(1) - x.col(0), v = x.col(2) - x.col(0);
  const double twice = u.x() * v.y() - u.y() * v.x();
  Eigen::Matrix<double, 3, 6> B = Eigen::Matrix<double, 3, 6>::Zero();
  for (int a = 0; a < 3; ++a) {
    const Eigen::Vector2d side = x.col((a + 2) % 3) - x.col((a + 1) % 3);
    const Eigen::Vector2d g = Eigen::Vector2d(-side.y(), side.x()) / twice;
    B(0, 2 * a) = B(2, 2 * a + 1) = g.x();
    B(1, 2 * a + 1) = B(2, 2 * a) = g.y();
  }
  return 0.5 * twice * B.transpose() * D * B;
}

Eigen::Matrix3d planeStressMatrix(const PlanePlate& plate) {
  const double nu = plate.poisson_ratio;
  Eigen::Matrix3d D;
  D << 1.0, nu, 0.0, nu, 1.0, 0.0, 0.0, 0.0, 0.5 * (1.0 - nu);
  return plate.young_modulus / (1.0 - nu * nu) * D;
}

void makeCells(int cells, PlateOfTriangles* made) {
  const int corners = (cells + 1) * (cells + 1);
  made->points.resize(2, corners + cells * cells);
  made->triangles.resize(3, 4 * cells * cells);
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      made->points.col(j * (cells + 1) + i) = Eigen::Vector2d(i, j) / cells;
    }
  }
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const int cell = j * cells + i, first = j * (cells + 1) + i;
      const int around[4] = {first, first + 1, first + cells + 2, first + cells + 1};
      made->points.col(corners + cell) = Eigen::Vector2d(i + 0.5, j + 0.5) / cells;
      for (int k = 0; k < 4; ++k) {
        made->triangles.col(4 * cell + k) << around[k], around[(k + 1) % 4], corners + cell;
      }
    }
  }
}

}  // namespace

PlateOfTriangles plateOfTriangles(const PlanePlate& plate, int cells) {
  PlateOfTriangles made;
  makeCells(cells, &made);
  const Eigen::Index size = made.points.size();
  const Eigen::Matrix3d D = planeStressMatrix(plate);
  Triplets entries;
  for (const auto& corners : made.triangles.colwise()) {
    Eigen::Matrix<double, 2, 3> x;
    for (int a = 0; a < 3; ++a) x.col(a) = made.points.col(corners[a]);
    const Eigen::Matrix<double, 6, 6> K = stiffness(x, D);
    for (int r = 0; r < 6; ++r) {
      for (int c = 0; c < 6; ++c) {
        entries.emplace_back(2 * corners[r / 2] + r % 2, 2 * corners[c / 2] + c % 2, K(r, c));
      }
    }
  }
  made.matrix.resize(size, size);
  made.matrix.setFromTriplets(entries.begin(), entries.end());

  Eigen::VectorXd f = Eigen::VectorXd::Zero(size);
  for (int j = 0; j <= cells; ++j) {
    f[2 * (j * (cells + 1) + cells)] = plate.traction / cells * (j == 0 || j == cells ? 0.5 : 1.0);
  }
  // Clamped nodes: rows and columns of the identity.
  Triplets free;
  const auto clamped = [&](Eigen::Index row) { return made.points(0, row / 2) == 0.0; };
  for (Eigen::Index c = 0; c < size; ++c) {
    if (clamped(c)) free.emplace_back(c, c, 1.0);
    for (Eigen::SparseMatrix<double>::InnerIterator k(made.matrix, c); k; ++k) {
      if (!clamped(c) && !clamped(k.row())) free.emplace_back(k.row(), c, k.value());
    }
  }
  Eigen::SparseMatrix<double> A(size, size);
  A.setFromTriplets(free.begin(), free.end());
  const Eigen::VectorXd u = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(A).solve(f);
  made.displacement = Eigen::Map<const Eigen::Matrix2Xd>(u.data(), 2, made.points.cols());
  return made;
}

PlateOfElements plateOfElements(const PlanePlate& plate, int per_side) {
  Eigen::Matrix2Xd points(2, 4 * per_side);
  Eigen::Matrix2Xi ends(2, 4 * per_side);
  PlaneConditions conditions(4 * per_side);
  for (int k = 0; k < 4 * per_side; ++k) {
    const double s = static_cast<double>(k % per_side) / per_side;
    const int side = k / per_side;  // lower, right, upper, left
    points.col(k) = side == 0   ? Eigen::Vector2d(s, 0.0)
                    : side == 1 ? Eigen::Vector2d(1.0, s)
                    : side == 2 ? Eigen::Vector2d(1.0 - s, 1.0)
                                : Eigen::Vector2d(0.0, 1.0 - s);
    ends.col(k) << k, (k + 1) % (4 * per_side);
    if (side == 1) conditions.value(0, k) = plate.traction;
    if (side == 3) conditions.held.col(k).setConstant(true);
  }
  PlaneElements elements(points, ends, planeStress(plate.young_modulus, plate.poisson_ratio));
  PlaneSolution solution = elements.solve(conditions);
  return {std::move(elements), std::move(solution)};
}

}  // namespace palpate::bem

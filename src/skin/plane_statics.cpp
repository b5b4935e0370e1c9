// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/skin/plane_statics.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace palpate::skin {

Corners PlaneMesh::corners(std::size_t triangle) const {
  const std::array<int, 3>& nodes = triangles[triangle];
  Corners found;
  found << points.col(nodes[0]), points.col(nodes[1]), points.col(nodes[2]);
  return found;
}

int bandWidth(const PlaneMesh& mesh) {
  int difference = 0;
  for (const std::array<int, 3>& t : mesh.triangles) {
    const auto [low, high] = std::minmax_element(t.begin(), t.end());
    difference = std::max(difference, *high - *low);
  }
  return 2 * (difference + 1);
}

Eigen::SparseMatrix<double> stiffness(const PlaneMesh& mesh,
                                      const std::vector<Eigen::Matrix4d>& elasticity,
                                      Idealization idealization, double thickness) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(36 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto material = static_cast<std::size_t>(mesh.materials[t]);
    const TriangleStiffness K =
        triangleStiffness(mesh.corners(t), elasticity[material], idealization, thickness);
    for (int r = 0; r < 6; ++r) {
      for (int c = 0; c < 6; ++c) {
        entries.emplace_back(2 * mesh.triangles[t][static_cast<std::size_t>(r / 2)] + r % 2,
                             2 * mesh.triangles[t][static_cast<std::size_t>(c / 2)] + c % 2,
                             K(r, c));
      }
    }
  }
  Eigen::SparseMatrix<double> whole(mesh.points.size(), mesh.points.size());
  whole.setFromTriplets(entries.begin(), entries.end());
  return whole;
}

PlanePoints displacements(const Eigen::SparseMatrix<double>& stiffness, const PlanePoints& forces,
                          const PlanePoints& held, const PlanePoints& prescribed) {
  const Eigen::Index n = held.size();
  PlanePoints moved = prescribed.cwiseProduct(held);
  const Eigen::VectorXd load = Eigen::Map<const Eigen::VectorXd>(forces.data(), n) -
                               stiffness * Eigen::Map<const Eigen::VectorXd>(moved.data(), n);
  std::vector<int> number(static_cast<std::size_t>(n), -1), free;
  for (int i = 0; i < n; ++i) {
    if (held.data()[i] != 0.0) continue;
    number[static_cast<std::size_t>(i)] = static_cast<int>(free.size());
    free.push_back(i);
  }
  if (free.empty()) return moved;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(stiffness.nonZeros()));
  for (const int column : free) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(stiffness, column); entry; ++entry) {
      const int row = number[static_cast<std::size_t>(entry.row())];
      if (row >= 0)
        entries.emplace_back(row, number[static_cast<std::size_t>(column)], entry.value());
    }
  }
  const auto size = static_cast<Eigen::Index>(free.size());
  Eigen::SparseMatrix<double> inner(size, size);
  inner.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor(inner);
  if (factor.info() != Eigen::Success) {
    throw std::domain_error("the stiffness is not positive definite: too little is held");
  }
  Eigen::VectorXd right(size);
  for (Eigen::Index i = 0; i < size; ++i) right[i] = load[free[static_cast<std::size_t>(i)]];
  const Eigen::VectorXd solution = factor.solve(right);
  for (Eigen::Index i = 0; i < size; ++i)
    moved.data()[free[static_cast<std::size_t>(i)]] = solution[i];
  return moved;
}

}  // namespace palpate::skin

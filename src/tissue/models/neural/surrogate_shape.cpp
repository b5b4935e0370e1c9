// SPDX-License-Identifier: GPL-3.0-or-later
#include "surrogate_shape.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <stdexcept>
#include <string>
#include <vector>

#include "palpate/mesh/surface_points.h"

namespace palpate::tissue {
namespace {

constexpr double kElsewhere = 0.05;  // largest distance over the body's size [-]

// Solves for values at columns that are not `given`, each the mean of its neighbours.
void fill(const mesh::CellMesh& body, const std::vector<bool>& given, Eigen::MatrixX3d* values) {
  std::vector<int> number(given.size(), -1);
  int unknown = 0;
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (!given[i]) number[i] = unknown++;
  }
  if (unknown == 0) return;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(unknown, 3);
  const auto add = [&](int i, int j) {
    const int row = number[static_cast<std::size_t>(i)],
              column = number[static_cast<std::size_t>(j)];
    if (row < 0) return;
    entries.emplace_back(row, row, 1.0);
    if (column >= 0) entries.emplace_back(row, column, -1.0);
    if (column < 0) right.row(row) += values->row(j);
  };
  for (const auto& [i, j] : mesh::edgesOf(body)) {
    add(i, j);
    add(j, i);
  }
  Eigen::SparseMatrix<double> laplacian(unknown, unknown);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(laplacian);
  const Eigen::MatrixX3d found = factor.solve(right);
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (number[i] >= 0) values->row(static_cast<Eigen::Index>(i)) = found.row(number[i]);
  }
}

}  // namespace

SurrogateShape::SurrogateShape(const enrichment::Surrogate& surrogate, const mesh::CellMesh& body,
                               const Eigen::Matrix3Xi& boundary, const fem::FreeMask& free,
                               const Mat3& R_WO)
    : modes_(body.points.size(), surrogate.numModes()) {
  const Points& X = body.points;
  const std::vector<mesh::SurfacePoint> places = mesh::nearestSurfacePoints(surrogate.surface, X);
  Points there;
  mesh::interpolate(places, surrogate.surface.points, &there);
  std::vector<bool> given(static_cast<std::size_t>(X.cols()), false);
  const double size = (X.rowwise().maxCoeff() - X.rowwise().minCoeff()).norm();
  for (const int i : boundary.reshaped()) {
    given[static_cast<std::size_t>(i)] = true;
    if ((there.col(i) - X.col(i)).norm() > kElsewhere * size) {
      throw std::invalid_argument(
          "neural: file: was learned of another body: a point of this one is " +
          std::to_string((there.col(i) - X.col(i)).norm()) + " m beside its surface");
    }
  }
  Points values;
  for (Eigen::Index m = 0; m < modes_.cols(); ++m) {
    const Eigen::VectorXd mode = surrogate.modes.col(m).cast<double>();
    mesh::interpolate(places, Eigen::Map<const Points>(mode.data(), 3, mode.size() / 3), &values);
    values = values.cwiseProduct(free).eval();
    Eigen::MatrixX3d rows = values.transpose();
    fill(body, given, &rows);
    const Points turned = R_WO * rows.transpose();
    modes_.col(m) = Eigen::Map<const Eigen::VectorXd>(turned.data(), turned.size());
  }
}

void SurrogateShape::displace(const Eigen::VectorXd& coefficients, Points* x) const {
  Eigen::Map<Eigen::VectorXd>(x->data(), x->size()) += modes_.lazyProduct(coefficients);
}

}  // namespace palpate::tissue

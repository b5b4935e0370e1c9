// SPDX-License-Identifier: GPL-3.0-or-later
#include "organ_cells.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace palpate::torture {
namespace {

// Mid-edge nodes from each corner to the four corners, in VTK's order.
constexpr std::array<std::array<int, 4>, 4> kMiddle = {
    {{-1, 4, 6, 7}, {4, -1, 5, 8}, {6, 5, -1, 9}, {7, 8, 9, -1}}};

// Determinant of the derivative of position by three of the barycentric coordinates, at w.
template <class Cell>
double jacobianAt(const Eigen::Vector4d& w, const Points& x, const Cell& cell) {
  Eigen::Matrix<double, 3, 4> by;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto col = static_cast<Eigen::Index>(i);
    by.col(col) = (4.0 * w[col] - 1.0) * x.col(cell[col]);
    for (std::size_t j = 0; j < 4; ++j) {
      if (j != i) by.col(col) += 4.0 * w[static_cast<int>(j)] * x.col(cell[kMiddle[i][j]]);
    }
  }
  Mat3 D;
  for (int k = 0; k < 3; ++k) D.col(k) = by.col(k + 1) - by.col(0);
  return D.determinant();
}

// At four points with the coordinate `near` for one corner and `other` for the rest.
double leastAtFour(double near, double other, const mesh::CellMesh& rest, const Points& now) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index t = 0; t < rest.numCells(); ++t) {
    const auto cell = rest.cells.col(t);
    for (int k = 0; k < 4; ++k) {
      Eigen::Vector4d w = Eigen::Vector4d::Constant(other);
      w[k] = near;
      least = std::min(least, jacobianAt(w, now, cell) / jacobianAt(w, rest.points, cell));
    }
  }
  return least;
}

}  // namespace

const mesh::CellMesh& OrganCells::of(const sim::Simulator& simulator, int organ) {
  kept_.resize(static_cast<std::size_t>(simulator.numOrgans()));
  Kept& kept = kept_[static_cast<std::size_t>(organ)];
  const std::uint64_t revision = simulator.surfaceState(organ).revision;
  if (!kept.made || kept.revision != revision) {
    kept = {simulator.cells(organ), revision, true};
  }
  return kept.cells;
}

bool areLinearTets(const mesh::CellMesh& cells) {
  return cells.cells.rows() == 4 && cells.cells.cols() > 0;
}

double leastVolumeRatio(const mesh::CellMesh& rest, const Points& now) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index t = 0; t < rest.numCells(); ++t) {
    const Eigen::Vector4i tet = rest.cells.col(t);
    least = std::min(least, mesh::signedVolume(now, tet) / mesh::signedVolume(rest.points, tet));
  }
  return least;
}

bool areQuadraticTets(const mesh::CellMesh& cells) {
  return cells.cells.rows() == 10 && cells.cells.cols() > 0;
}

double leastAtCorners(const mesh::CellMesh& rest, const Points& now) {
  return leastAtFour(1.0, 0.0, rest, now);
}

double leastAtQuadraturePoints(const mesh::CellMesh& rest, const Points& now) {
  const double other = (5.0 - std::sqrt(5.0)) / 20.0;
  return leastAtFour(1.0 - 3.0 * other, other, rest, now);
}

}  // namespace palpate::torture

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/fem/composition.h"
#include "palpate/mesh/tet_mesh.h"
#include "shape_functions.h"

namespace palpate::fem {

/// An element's integration point at rest: F = sum_a x_a (x) g_a.
template <int N>
struct RestPoint {
  Eigen::Matrix<double, 3, N> gradients;  ///< g_a = grad N_a in the material frame [1/m].
  double volume;                          ///< [m^3]
};

/// Elements of N nodes in their rest configuration.
template <int N>
struct RestShape {
  static constexpr int kPoints = Tetrahedron<N>::kPoints;
  using Nodes = Eigen::Matrix<int, N, Eigen::Dynamic>;

  /// @throws std::invalid_argument for other elements, or an inverted or degenerate one, with its
  /// number.
  RestShape(const mesh::TetMesh& mesh, const Composition& composition);

  Nodes nodes;                                            ///< Of each element.
  std::vector<std::array<RestPoint<N>, kPoints>> points;  ///< Of each element.
  std::vector<double> volumes;                            ///< Of each element [m^3].
  Eigen::VectorXd masses;                                 ///< Lumped, of each node, > 0 [kg].
  Eigen::VectorXd load_weights;  ///< Integral of density N_a at each node [kg].

  /// grad N_a at barycentric `w` of element `e`, in the reference frame.
  static Eigen::Matrix<double, 3, N> gradientsAt(const Eigen::Matrix<double, 3, N>& X,
                                                 const Eigen::Vector4d& w, double* determinant);
};

}  // namespace palpate::fem

// SPDX-License-Identifier: GPL-3.0-or-later
#include "rest_shape.h"

#include <Eigen/Dense>
#include <stdexcept>
#include <string>

namespace palpate::fem {
namespace {

Eigen::Matrix4Xi nodesOf(const mesh::TetMesh& mesh, std::integral_constant<int, 4>) {
  if (mesh.quadratic()) {
    throw std::invalid_argument(
        "needs 4-node tetrahedra; the mesh has 10-node ones, for tet10 and tet10p");
  }
  return mesh.tets;
}

Eigen::Matrix<int, 10, Eigen::Dynamic> nodesOf(const mesh::TetMesh& mesh,
                                               std::integral_constant<int, 10>) {
  if (!mesh.quadratic()) {
    throw std::invalid_argument("needs 10-node tetrahedra; the mesh has 4-node ones");
  }
  Eigen::Matrix<int, 10, Eigen::Dynamic> nodes(10, mesh.numTets());
  nodes.topRows<4>() = mesh.tets;
  nodes.bottomRows<6>() = mesh.midnodes;
  return nodes;
}

// Refuses elements inverted at corners, or with curved edges also at mid-edge nodes.
template <int N>
void refuseInverted(const Eigen::Matrix<double, 3, N>& X, Eigen::Index element) {
  constexpr int kPlaces = N == 4 ? 1 : N;  // linear elements have a constant determinant
  for (int k = 0; k < kPlaces; ++k) {
    Eigen::Vector4d w = Eigen::Vector4d::Zero();
    if (k < 4) {
      w[k] = 1.0;
    } else {
      for (int corner : Tetrahedron<10>::kEdges[k - 4]) w[corner] = 0.5;
    }
    double determinant = 0.0;
    RestShape<N>::gradientsAt(X, w, &determinant);
    if (determinant > 0.0) continue;
    throw std::invalid_argument("tetrahedron " + std::to_string(element + 1) +
                                " is inverted or has no volume" +
                                (N == 10 ? " where its edges are bent" : ""));
  }
}

}  // namespace

template <int N>
Eigen::Matrix<double, 3, N> RestShape<N>::gradientsAt(const Eigen::Matrix<double, 3, N>& X,
                                                      const Eigen::Vector4d& w,
                                                      double* determinant) {
  const Eigen::Matrix<double, N, 4> by_weight = Tetrahedron<N>::derivatives(w);
  // w0 = 1 - w1 - w2 - w3 leaves three independent coordinates.
  const Eigen::Matrix<double, N, 3> d =
      by_weight.template rightCols<3>().colwise() - by_weight.col(0);
  const Mat3 jacobian = X * d;
  *determinant = jacobian.determinant();
  return jacobian.inverse().transpose() * d.transpose();
}

template <int N>
RestShape<N>::RestShape(const mesh::TetMesh& mesh, const Composition& composition)
    : nodes(nodesOf(mesh, std::integral_constant<int, N>())),
      masses(Eigen::VectorXd::Zero(mesh.numPoints())),
      load_weights(Eigen::VectorXd::Zero(mesh.numPoints())) {
  using Shape = Tetrahedron<N>;
  points.resize(static_cast<std::size_t>(nodes.cols()));
  for (Eigen::Index e = 0; e < nodes.cols(); ++e) {
    Eigen::Matrix<double, 3, N> X;
    for (int a = 0; a < N; ++a) X.col(a) = mesh.points.col(nodes(a, e));
    refuseInverted<N>(X, e);
    const double density = composition.solid(static_cast<int>(e)).density;
    double volume = 0.0;
    for (int q = 0; q < kPoints; ++q) {
      double determinant = 0.0;
      RestPoint<N>& point = points[e][q];
      point.gradients = gradientsAt(X, Shape::point(q), &determinant);
      if (!composition.frames.empty()) {
        point.gradients = composition.frames[e].transpose() * point.gradients;
      }
      point.volume = determinant / (6.0 * kPoints);
      volume += point.volume;
      const auto weights = Shape::values(Shape::point(q));
      for (int a = 0; a < N; ++a) load_weights[nodes(a, e)] += density * point.volume * weights[a];
    }
    volumes.push_back(volume);
    for (int a = 0; a < N; ++a) {
      masses[nodes(a, e)] += density * volume * Shape::massFractions()[a];
    }
  }
}

template struct RestShape<4>;
template struct RestShape<10>;

}  // namespace palpate::fem

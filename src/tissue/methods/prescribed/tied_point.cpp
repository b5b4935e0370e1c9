// SPDX-License-Identifier: GPL-3.0-or-later
#include "tied_point.h"

#include <cmath>
#include <vector>

namespace palpate::tissue {
namespace {

// Least weight of a free node that can move the point [-].
constexpr double kLeastWeight = 1e-6;

}  // namespace

TiedPoint::TiedPoint(const Eigen::Vector3i& nodes, const Vec3& weights, const fem::FreeMask& free)
    : nodes_(nodes) {
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < 3; ++k) weights_(c, k) = weights[k] * free(c, nodes[k]);
    int pivot = 0;
    if (weights_.row(c).maxCoeff(&pivot) < kLeastWeight) {
      weights_.row(c).setZero();
    } else {
      pivots_[c] = pivot;
    }
  }
}

void TiedPoint::addMove(const Vec3& way, Points* move) const {
  for (int c = 0; c < 3; ++c) {
    if (pivots_[c] < 0) continue;
    const double scale = way[c] / weights_.row(c).squaredNorm();
    for (int k = 0; k < 3; ++k) (*move)(c, nodes_[k]) += scale * weights_(c, k);
  }
}

Vec3 TiedPoint::force(const Points& gradient) const {
  Vec3 sum = Vec3::Zero();
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < 3; ++k) {
      if (weights_(c, k) > 0.0) sum[c] += gradient(c, nodes_[k]);
    }
  }
  return sum;
}

// Least squares, exact in equilibrium.
Vec3 TiedPoint::multiplier(const Points& gradient) const {
  Vec3 force = Vec3::Zero();
  for (int c = 0; c < 3; ++c) {
    if (pivots_[c] < 0) continue;
    for (int k = 0; k < 3; ++k) force[c] += weights_(c, k) * gradient(c, nodes_[k]);
    force[c] /= weights_.row(c).squaredNorm();
  }
  return force;
}

void TiedPoint::balance(Points* gradient) const {
  const Vec3 force = multiplier(*gradient);
  for (int k = 0; k < 3; ++k) gradient->col(nodes_[k]) -= weights_.col(k).cwiseProduct(force);
}

double TiedPoint::nodalNorm(const Points& gradient) const {
  const Vec3 force = multiplier(gradient);
  return (force.asDiagonal() * weights_).norm();
}

// With Z = 1 - E W', e_c of the pivots in E and w_c over the pivot's weight in W,
// Z' A Z = A - W G' - G W' with G = A E - W (E' A E)/2.
void TiedPoint::reduce(Eigen::SparseMatrix<double>* A) const {
  const auto n = static_cast<std::size_t>(A->rows());
  std::vector<int> tied;  // components
  for (int c = 0; c < 3; ++c) {
    if (pivots_[c] >= 0) tied.push_back(c);
  }
  const auto place = [&](int c, int k) { return 3 * nodes_[k] + c; };
  std::vector<std::vector<double>> G;  // dense, since small
  for (const int c : tied) {
    G.emplace_back(n, 0.0);
    for (Eigen::SparseMatrix<double>::InnerIterator a(*A, place(c, pivots_[c])); a; ++a) {
      G.back()[static_cast<std::size_t>(a.row())] = a.value();
    }
  }
  const std::vector<std::vector<double>> AE = G;
  const auto over = [&](int c, int k) { return weights_(c, k) / weights_(c, pivots_[c]); };
  for (std::size_t j = 0; j < tied.size(); ++j) {
    for (std::size_t i = 0; i < tied.size(); ++i) {
      const int c = tied[i];
      const double half = 0.5 * AE[j][static_cast<std::size_t>(place(c, pivots_[c]))];
      for (int k = 0; k < 3; ++k) {
        G[j][static_cast<std::size_t>(place(c, k))] -= over(c, k) * half;
      }
    }
  }
  std::vector<Eigen::Triplet<double>> change;
  for (std::size_t j = 0; j < tied.size(); ++j) {
    const int c = tied[j];
    for (int row = 0; row < A->rows(); ++row) {
      const double g = G[j][static_cast<std::size_t>(row)];
      if (g == 0.0) continue;
      for (int k = 0; k < 3; ++k) {
        if (weights_(c, k) == 0.0) continue;
        change.emplace_back(place(c, k), row, -over(c, k) * g);
        change.emplace_back(row, place(c, k), -over(c, k) * g);
      }
    }
    const int pivot = place(c, pivots_[c]);
    change.emplace_back(pivot, pivot, AE[j][static_cast<std::size_t>(pivot)]);
  }
  Eigen::SparseMatrix<double> sum(A->rows(), A->cols());
  sum.setFromTriplets(change.begin(), change.end());
  *A += sum;
}

void TiedPoint::reduce(Points* right) const {
  for (int c = 0; c < 3; ++c) {
    if (pivots_[c] < 0) continue;
    const double own = (*right)(c, nodes_[pivots_[c]]);
    for (int k = 0; k < 3; ++k) {
      (*right)(c, nodes_[k]) -= weights_(c, k) / weights_(c, pivots_[c]) * own;
    }
    (*right)(c, nodes_[pivots_[c]]) = 0.0;
  }
}

void TiedPoint::expand(Points* v) const {
  for (int c = 0; c < 3; ++c) {
    if (pivots_[c] < 0) continue;
    double others = 0.0;
    for (int k = 0; k < 3; ++k) {
      if (k != pivots_[c]) others += weights_(c, k) * (*v)(c, nodes_[k]);
    }
    (*v)(c, nodes_[pivots_[c]]) = -others / weights_(c, pivots_[c]);
  }
}

}  // namespace palpate::tissue

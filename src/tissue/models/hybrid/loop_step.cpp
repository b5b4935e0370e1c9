// SPDX-License-Identifier: GPL-3.0-or-later
#include "loop_step.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <vector>

namespace palpate::tissue {
namespace {

constexpr int kSteps = 100;

// Of a symmetric operator on fields 3 x n: its largest eigenvalue, with all vectors made
// orthogonal to each other. `v`: where to begin.
template <class Apply>
double largestEigenvalue(const Apply& apply, Points v) {
  std::vector<Points> basis;
  std::vector<double> diagonal, beside;
  Points next;
  v /= v.norm();
  for (int k = 0; k < kSteps; ++k) {
    basis.push_back(v);
    apply(v, &next);
    diagonal.push_back(next.cwiseProduct(v).sum());
    for (int again = 0; again < 2; ++again) {
      for (const Points& b : basis) next -= next.cwiseProduct(b).sum() * b;
    }
    const double length = next.norm();
    if (!(length > 1e-12 * std::abs(diagonal.front()))) break;
    beside.push_back(length);
    v = next / length;
  }
  const auto size = static_cast<Eigen::Index>(diagonal.size());
  const Eigen::VectorXd d = Eigen::Map<Eigen::VectorXd>(diagonal.data(), size);
  beside.resize(static_cast<std::size_t>(size), 0.0);
  const Eigen::VectorXd b = Eigen::Map<Eigen::VectorXd>(beside.data(), size - 1);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes;
  modes.computeFromTridiagonal(d, b, Eigen::EigenvaluesOnly);
  return modes.eigenvalues()[size - 1];
}

}  // namespace

double longestLoopStep(const fem::BlockMatrix& together, const fem::BlockMatrix& region,
                       const Eigen::VectorXd& masses, const fem::FreeMask& moves, double damping) {
  if (moves.isZero(0.0)) return std::numeric_limits<double>::infinity();
  const Points scale = moves * masses.cwiseSqrt().cwiseInverse().asDiagonal();
  Points u, both, own;
  const auto apply = [&](const Points& v, Points* out) {
    u = v.cwiseProduct(scale);
    together.multiply(u, &both);
    region.multiply(u, &own);
    *out = (both - 2.0 * own).cwiseProduct(scale);
  };
  // No mode is orthogonal to it but by chance.
  Points begin = moves;
  for (Eigen::Index k = 0; k < begin.size(); ++k) {
    begin.data()[k] *= 1.0 + 0.5 * std::sin(1.7 * static_cast<double>(k * k % 1009));
  }
  const double square = largestEigenvalue(apply, begin);
  if (!(square > 0.0)) return std::numeric_limits<double>::infinity();
  return (damping + std::sqrt(damping * damping + 4.0 * square)) / square;
}

}  // namespace palpate::tissue

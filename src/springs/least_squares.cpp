// SPDX-License-Identifier: GPL-3.0-or-later
#include "least_squares.h"

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace palpate::springs {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

// 1 over the length of each column; 1 where it is empty.
Eigen::VectorXd columnScales(const SparseMatrix& A) {
  Eigen::VectorXd scales(A.cols());
  for (int c = 0; c < A.outerSize(); ++c) {
    const double norm = A.col(c).norm();
    scales[c] = norm > 0.0 ? 1.0 / norm : 1.0;
  }
  return scales;
}

void append(const SparseMatrix& block, Eigen::Index row, Eigen::Index column, Triplets* entries) {
  for (int c = 0; c < block.outerSize(); ++c) {
    for (SparseMatrix::InnerIterator entry(block, c); entry; ++entry) {
      entries->emplace_back(row + entry.row(), column + entry.col(), entry.value());
    }
  }
}

enum class Place : char { kFree, kLower, kUpper };

// Minimiser over the free unknowns, the others at their bounds. `H` is positive definite.
Eigen::VectorXd minimiseFree(const SparseMatrix& H, const Eigen::VectorXd& g,
                             const Eigen::VectorXd& upper, const std::vector<Place>& place) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(g.size());
  std::vector<int> number(place.size(), -1);
  int size = 0;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] == Place::kFree) number[i] = size++;
    if (place[i] == Place::kUpper) x[static_cast<Eigen::Index>(i)] = upper[static_cast<int>(i)];
  }
  if (size == 0) return x;
  const Eigen::VectorXd left = g - H * x;
  Triplets entries;
  Eigen::VectorXd right(size);
  for (int c = 0; c < H.outerSize(); ++c) {
    const int column = number[static_cast<std::size_t>(c)];
    if (column < 0) continue;
    right[column] = left[c];
    for (SparseMatrix::InnerIterator entry(H, c); entry; ++entry) {
      const int row = number[static_cast<std::size_t>(entry.row())];
      if (row >= 0) entries.emplace_back(row, column, entry.value());
    }
  }
  SparseMatrix free(size, size);
  free.setFromTriplets(entries.begin(), entries.end());
  Eigen::CholmodSupernodalLLT<SparseMatrix> factor;
  factor.cholmod().print = 0;
  factor.compute(free);
  if (factor.info() != Eigen::Success) throw std::runtime_error("least squares: no factor");
  const Eigen::VectorXd solution = factor.solve(right);
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (number[i] >= 0) x[static_cast<Eigen::Index>(i)] = solution[number[i]];
  }
  return x;
}

}  // namespace

Eigen::VectorXd equalityLeastSquares(const SparseMatrix& A, const Eigen::VectorXd& b,
                                     const SparseMatrix& C) {
  constexpr double kProximity = 1e-8;  // small beside the columns and rows, whose length is 1
  constexpr int kSteps = 40;
  const Eigen::Index n = A.cols(), m = C.rows();
  const Eigen::VectorXd scale = columnScales(A);
  const SparseMatrix scaled = A * scale.asDiagonal();
  const SparseMatrix turned = (C * scale.asDiagonal()).transpose();
  const SparseMatrix rows_of_unit_length =
      SparseMatrix(turned * columnScales(turned).asDiagonal()).transpose();
  Triplets entries;
  append(SparseMatrix(scaled.transpose() * scaled), 0, 0, &entries);
  append(rows_of_unit_length, n, 0, &entries);
  append(SparseMatrix(rows_of_unit_length.transpose()), 0, n, &entries);
  for (Eigen::Index i = 0; i < n + m; ++i)
    entries.emplace_back(i, i, i < n ? kProximity : -kProximity);
  SparseMatrix K(n + m, n + m);
  K.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<SparseMatrix> factor(K);
  if (factor.info() != Eigen::Success) throw std::runtime_error("least squares: no factor");
  Eigen::VectorXd z = Eigen::VectorXd::Zero(n + m), left(n + m);
  for (int step = 0; step < kSteps; ++step) {
    // What is left of the system without the proximity.
    left.head(n) =
        scaled.transpose() * (b - scaled * z.head(n)) - rows_of_unit_length.transpose() * z.tail(m);
    left.tail(m) = -(rows_of_unit_length * z.head(n));
    const Eigen::VectorXd change = factor.solve(left);
    z += change;
    if (change.head(n).norm() <= 1e-15 * z.head(n).norm()) break;
  }
  return scale.cwiseProduct(z.head(n));
}

BoundedSolution boundedLeastSquares(const SparseMatrix& A, const Eigen::VectorXd& b,
                                    const Eigen::VectorXd& upper) {
  constexpr double kRidge = 1e-10;
  constexpr int kPatience = 10, kLimit = 2000;
  const Eigen::Index n = A.cols();
  const Eigen::VectorXd scale = columnScales(A), bound = upper.cwiseQuotient(scale);
  const SparseMatrix scaled = A * scale.asDiagonal();
  SparseMatrix identity(n, n);
  identity.setIdentity();
  const SparseMatrix H = SparseMatrix(scaled.transpose() * scaled) + kRidge * identity;
  const Eigen::VectorXd g = scaled.transpose() * b;
  const double size = std::max(b.norm(), 1e-300), tolerance = 1e-12 * size;

  std::vector<Place> place(static_cast<std::size_t>(n), Place::kFree);
  BoundedSolution solution;
  Eigen::Index fewest = n + 1;
  int patience = kPatience;
  for (;;) {
    if (solution.factorisations == kLimit) {
      throw std::runtime_error("least squares: the bounds that hold are not found");
    }
    const Eigen::VectorXd x = minimiseFree(H, g, bound, place);
    ++solution.factorisations;
    const Eigen::VectorXd slope = H * x - g;
    std::vector<std::pair<Eigen::Index, Place>> wrong;
    for (Eigen::Index i = 0; i < n; ++i) {
      Place& now = place[static_cast<std::size_t>(i)];
      if (now == Place::kFree && x[i] < -tolerance) wrong.emplace_back(i, Place::kLower);
      if (now == Place::kFree && x[i] > bound[i] + tolerance) wrong.emplace_back(i, Place::kUpper);
      if (now == Place::kLower && slope[i] < -tolerance) wrong.emplace_back(i, Place::kFree);
      if (now == Place::kUpper && slope[i] > tolerance) wrong.emplace_back(i, Place::kFree);
    }
    if (wrong.empty()) {
      for (Eigen::Index i = 0; i < n; ++i) {
        const Place now = place[static_cast<std::size_t>(i)];
        const double violation = now == Place::kFree    ? std::abs(slope[i])
                                 : now == Place::kLower ? std::max(0.0, -slope[i])
                                                        : std::max(0.0, slope[i]);
        solution.worst_gradient = std::max(solution.worst_gradient, violation / size);
      }
      solution.x = scale.cwiseProduct(x).cwiseMax(0.0).cwiseMin(upper);
      for (Eigen::Index i = 0; i < n; ++i) {
        if (place[static_cast<std::size_t>(i)] == Place::kUpper) solution.x[i] = upper[i];
      }
      return solution;
    }
    const auto count = static_cast<Eigen::Index>(wrong.size());
    const bool progress = count < fewest;
    if (progress) fewest = count;
    patience = progress ? kPatience : patience - 1;
    if (patience < 0) wrong.erase(wrong.begin(), wrong.end() - 1);
    for (const auto& [i, better] : wrong) place[static_cast<std::size_t>(i)] = better;
  }
}

}  // namespace palpate::springs

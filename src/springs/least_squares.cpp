// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/least_squares.h"

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace palpate::springs {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

// Inverse norm of each column; 1 for empty columns.
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

/// |A x - b|^2/2 within bounds, with A's columns of length 1.
class BoundedProblem {
 public:
  BoundedProblem(const SparseMatrix& A, const Eigen::VectorXd& b, Eigen::VectorXd upper)
      : upper_(std::move(upper)), H_(A.transpose() * A), g_(A.transpose() * b) {}

  /// Value without the constant |b|^2/2.
  double value(const Eigen::VectorXd& x) const { return x.dot(0.5 * (H_ * x) - g_); }
  Eigen::VectorXd slope(const Eigen::VectorXd& x) const { return H_ * x - g_; }
  Eigen::VectorXd within(const Eigen::VectorXd& x) const {
    return x.cwiseMax(0.0).cwiseMin(upper_);
  }
  /// Whether x is within `reach` of a bound and the slope points beyond it.
  bool bound(Eigen::Index i, double x, double slope, double reach) const {
    return (x <= reach && slope >= 0.0) || (x >= upper_[i] - reach && slope <= 0.0);
  }
  /// Newton step of the unbound unknowns, steepest descent of the others.
  Eigen::VectorXd newtonStep(const Eigen::VectorXd& x, const Eigen::VectorXd& slope,
                             double reach) const;

 private:
  Eigen::VectorXd upper_;
  SparseMatrix H_;
  Eigen::VectorXd g_;
};

Eigen::VectorXd BoundedProblem::newtonStep(const Eigen::VectorXd& x, const Eigen::VectorXd& slope,
                                           double reach) const {
  constexpr double kRidge = 1e-7;
  std::vector<int> number(static_cast<std::size_t>(x.size()), -1);
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (bound(i, x[i], slope[i], reach)) continue;
    number[static_cast<std::size_t>(i)] = static_cast<int>(free.size());
    free.push_back(i);
  }
  const auto size = static_cast<Eigen::Index>(free.size());
  Eigen::VectorXd step = -slope, right(size);
  if (size == 0) return step;
  Triplets entries;
  for (Eigen::Index c = 0; c < size; ++c) {
    const Eigen::Index column = free[static_cast<std::size_t>(c)];
    right[c] = -slope[column];
    for (SparseMatrix::InnerIterator entry(H_, column); entry; ++entry) {
      const int row = number[static_cast<std::size_t>(entry.row())];
      if (row >= 0) entries.emplace_back(row, c, entry.value() + (row == c ? kRidge : 0.0));
    }
  }
  SparseMatrix part(size, size);
  part.setFromTriplets(entries.begin(), entries.end());
  Eigen::CholmodSupernodalLLT<SparseMatrix> factor;
  factor.cholmod().print = 0;
  factor.compute(part);
  if (factor.info() != Eigen::Success) throw std::runtime_error("least squares: no factor");
  const Eigen::VectorXd solution = factor.solve(right);
  for (Eigen::Index i = 0; i < size; ++i) step[free[static_cast<std::size_t>(i)]] = solution[i];
  return step;
}

}  // namespace

Eigen::VectorXd equalityLeastSquares(const SparseMatrix& A, const Eigen::VectorXd& b,
                                     const SparseMatrix& C) {
  constexpr double kProximity = 1e-8;  // small against columns and rows of unit length
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
    // Residual of the system without the proximal term.
    left.head(n) =
        scaled.transpose() * (b - scaled * z.head(n)) - rows_of_unit_length.transpose() * z.tail(m);
    left.tail(m) = -(rows_of_unit_length * z.head(n));
    const Eigen::VectorXd change = factor.solve(left);
    z += change;
    if (change.head(n).norm() <= 1e-15 * z.head(n).norm()) break;
  }
  if (m > 0 && (rows_of_unit_length * z.head(n)).cwiseAbs().maxCoeff() > 1e-9 * z.head(n).norm()) {
    throw std::runtime_error("least squares: the equalities are not kept");
  }
  return scale.cwiseProduct(z.head(n));
}

BoundedSolution boundedLeastSquares(const SparseMatrix& A, const Eigen::VectorXd& b,
                                    const Eigen::VectorXd& upper) {
  constexpr double kFlat = 1e-10;  // over |b|: accepted as optimal
  constexpr double kNearlyFlat = 1e-7;
  constexpr double kSufficientDecrease = 1e-4, kRounding = 1e-15;
  constexpr int kPatience = 5;
  constexpr double kReach = 1e-7;  // over |b|: reach of bounds
  constexpr int kLimit = 500;
  const Eigen::VectorXd scale = columnScales(A);
  const BoundedProblem problem(A * scale.asDiagonal(), b, upper.cwiseQuotient(scale));
  const double size = std::max(b.norm(), 1e-300);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(A.cols());
  double value = 0.0;
  double flattest = std::numeric_limits<double>::infinity();
  int idle = 0;
  BoundedSolution solution;
  for (;;) {
    const Eigen::VectorXd slope = problem.slope(x);
    // Projected gradient step; 0 at the optimum.
    const Eigen::VectorXd pushed = (problem.within(x - slope) - x).cwiseAbs();
    const double push = pushed.size() == 0 ? 0.0 : pushed.maxCoeff();
    solution.worst_gradient = push / size;
    if (solution.worst_gradient <= kFlat) break;
    if (solution.worst_gradient < 0.5 * flattest) {
      flattest = solution.worst_gradient;
      idle = 0;
    }
    if (flattest < kNearlyFlat && ++idle > kPatience) break;  // only rounding is left
    if (solution.factorisations == kLimit) break;
    const Eigen::VectorXd step = problem.newtonStep(x, slope, std::min(kReach * size, push));
    ++solution.factorisations;
    bool moved = false;
    for (double alpha = 1.0; alpha > 1e-12; alpha *= 0.5) {
      const Eigen::VectorXd trial = problem.within(x + alpha * step);
      const double next = problem.value(trial);
      if (next > value + kSufficientDecrease * slope.dot(trial - x) + kRounding * std::abs(value)) {
        continue;
      }
      moved = true;
      x = trial;
      value = next;
      break;
    }
    if (!moved) break;
  }
  if (!(solution.worst_gradient <= kNearlyFlat)) {
    throw std::runtime_error("least squares: the bounds that hold are not found");
  }
  solution.x = scale.cwiseProduct(x).cwiseMin(upper);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (x[i] >= upper[i] / scale[i]) solution.x[i] = upper[i];
  }
  return solution;
}

}  // namespace palpate::springs

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

/// |A x - b|^2 with bounds, A's columns of length 1, and where each unknown is.
class BoundedProblem {
 public:
  BoundedProblem(const SparseMatrix& A, const Eigen::VectorXd& b, Eigen::VectorXd upper)
      : place(static_cast<std::size_t>(A.cols()), Place::kFree),
        H_(A.transpose() * A),
        g_(A.transpose() * b),
        upper_(std::move(upper)),
        steep_(1e-9 * std::max(b.norm(), 1e-300)) {}

  std::vector<Place> place;

  Eigen::VectorXd slope(const Eigen::VectorXd& x) const { return H_ * x - g_; }
  const Eigen::VectorXd& upper() const { return upper_; }
  int factorisations() const { return factorisations_; }

  /// Where an unknown with this value and slope should be: elsewhere, or where it is.
  Place better(Eigen::Index i, double x, double slope, double off) const {
    const Place now = place[static_cast<std::size_t>(i)];
    if (now == Place::kFree && x < -off) return Place::kLower;
    if (now == Place::kFree && x > upper_[i] + off) return Place::kUpper;
    if (now == Place::kLower && slope < -steep_) return Place::kFree;
    if (now == Place::kUpper && slope > steep_) return Place::kFree;
    return now;
  }

  /// Minimiser over the free unknowns, the others at their bounds.
  Eigen::VectorXd minimiseFree();

 private:
  SparseMatrix H_;
  Eigen::VectorXd g_, upper_;
  double steep_;
  int factorisations_ = 0;
};

Eigen::VectorXd BoundedProblem::minimiseFree() {
  constexpr double kRidge = 1e-7;
  constexpr int kRefinements = 3;
  if (++factorisations_ > 5000) {
    throw std::runtime_error("least squares: the bounds that hold are not found");
  }
  Eigen::VectorXd x = Eigen::VectorXd::Zero(g_.size());
  std::vector<int> number(place.size(), -1);
  std::vector<Eigen::Index> unknowns;
  for (std::size_t i = 0; i < place.size(); ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    if (place[i] == Place::kUpper) x[index] = upper_[index];
    if (place[i] != Place::kFree) continue;
    number[i] = static_cast<int>(unknowns.size());
    unknowns.push_back(index);
  }
  const auto size = static_cast<Eigen::Index>(unknowns.size());
  if (size == 0) return x;
  Triplets entries;
  for (Eigen::Index c = 0; c < size; ++c) {
    for (SparseMatrix::InnerIterator entry(H_, unknowns[static_cast<std::size_t>(c)]); entry;
         ++entry) {
      const int row = number[static_cast<std::size_t>(entry.row())];
      if (row >= 0) entries.emplace_back(row, c, entry.value() + (row == c ? kRidge : 0.0));
    }
  }
  SparseMatrix free(size, size);
  free.setFromTriplets(entries.begin(), entries.end());
  Eigen::CholmodSupernodalLLT<SparseMatrix> factor;
  factor.cholmod().print = 0;
  factor.compute(free);
  if (factor.info() != Eigen::Success) throw std::runtime_error("least squares: no factor");
  for (int step = 0; step <= kRefinements; ++step) {
    const Eigen::VectorXd left = -slope(x);
    const Eigen::VectorXd change = factor.solve(Eigen::VectorXd::NullaryExpr(
        size, [&](Eigen::Index i) { return left[unknowns[static_cast<std::size_t>(i)]]; }));
    for (Eigen::Index i = 0; i < size; ++i) x[unknowns[static_cast<std::size_t>(i)]] += change[i];
  }
  return x;
}

double rounding(const Eigen::VectorXd& x) { return 1e-8 * x.cwiseAbs().maxCoeff(); }

// All that are in a wrong place change it at once, until none is, or that makes no progress.
bool exchangeBlocks(BoundedProblem* problem, Eigen::VectorXd* x) {
  constexpr int kPatience = 10;
  Eigen::Index fewest = x->size() + 1;
  for (int patience = kPatience; patience > 0;) {
    *x = problem->minimiseFree();
    const Eigen::VectorXd slope = problem->slope(*x);
    const double off = rounding(*x);
    Eigen::Index count = 0;
    for (Eigen::Index i = 0; i < x->size(); ++i) {
      Place& place = problem->place[static_cast<std::size_t>(i)];
      const Place better = problem->better(i, (*x)[i], slope[i], off);
      count += better != place;
      place = better;
    }
    if (count == 0) return true;
    patience = count < fewest ? kPatience : patience - 1;
    fewest = std::min(fewest, count);
  }
  return false;
}

// From what is within the bounds: to the minimum over the free unknowns or as far as the first
// bound, and where that is a minimum, one more is set free. Every step makes the squares less.
void descend(BoundedProblem* problem, Eigen::VectorXd* x) {
  *x = x->cwiseMax(0.0).cwiseMin(problem->upper());
  for (Eigen::Index i = 0; i < x->size(); ++i) {
    problem->place[static_cast<std::size_t>(i)] = (*x)[i] <= 0.0                   ? Place::kLower
                                                  : (*x)[i] >= problem->upper()[i] ? Place::kUpper
                                                                                   : Place::kFree;
  }
  for (;;) {
    const Eigen::VectorXd best = problem->minimiseFree();
    const double off = rounding(best);
    double share = 1.0;
    for (Eigen::Index i = 0; i < x->size(); ++i) {
      const double from = (*x)[i], to = best[i], bound = to < from ? 0.0 : problem->upper()[i];
      if (to < -off || to > problem->upper()[i] + off) {
        share = std::min(share, (bound - from) / (to - from));
      }
    }
    if (share < 1.0) {
      *x += share * (best - *x);
      for (Eigen::Index i = 0; i < x->size(); ++i) {
        Place& place = problem->place[static_cast<std::size_t>(i)];
        if (place != Place::kFree || best[i] == (*x)[i]) continue;
        if (best[i] < -off && (*x)[i] <= off) place = Place::kLower;
        if (best[i] > problem->upper()[i] + off && (*x)[i] >= problem->upper()[i] - off) {
          place = Place::kUpper;
        }
      }
      continue;
    }
    *x = best;
    const Eigen::VectorXd slope = problem->slope(best);
    Eigen::Index steepest = -1;
    for (Eigen::Index i = 0; i < x->size(); ++i) {
      const Place place = problem->place[static_cast<std::size_t>(i)];
      if (place == Place::kFree || problem->better(i, best[i], slope[i], off) == place) continue;
      if (steepest < 0 || std::abs(slope[i]) > std::abs(slope[steepest])) steepest = i;
    }
    if (steepest < 0) return;
    problem->place[static_cast<std::size_t>(steepest)] = Place::kFree;
  }
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
  const Eigen::VectorXd scale = columnScales(A);
  BoundedProblem problem(A * scale.asDiagonal(), b, upper.cwiseQuotient(scale));
  Eigen::VectorXd x = Eigen::VectorXd::Zero(A.cols());
  if (!exchangeBlocks(&problem, &x)) descend(&problem, &x);

  const Eigen::VectorXd slope = problem.slope(x);
  BoundedSolution solution{scale.cwiseProduct(x).cwiseMax(0.0).cwiseMin(upper),
                           problem.factorisations(), 0.0};
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Place place = problem.place[static_cast<std::size_t>(i)];
    if (place == Place::kUpper) solution.x[i] = upper[i];
    const double violation = place == Place::kFree    ? std::abs(slope[i])
                             : place == Place::kLower ? std::max(0.0, -slope[i])
                                                      : std::max(0.0, slope[i]);
    solution.worst_gradient =
        std::max(solution.worst_gradient, violation / std::max(b.norm(), 1e-300));
  }
  return solution;
}

}  // namespace palpate::springs

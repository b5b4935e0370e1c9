// SPDX-License-Identifier: GPL-3.0-or-later
#include "rank_one_correction.h"

#include <Eigen/LU>
#include <vector>

namespace palpate::solver {
namespace {

double product(const fem::RankOnes::Term& term, const Points& x) {
  double sum = 0.0;
  for (std::size_t k = 0; k < term.nodes.size(); ++k) {
    sum += term.a.col(static_cast<Eigen::Index>(k)).dot(x.col(term.nodes[k]));
  }
  return sum;
}

}  // namespace

SolveStatus solveWithRankOnes(
    const fem::RankOnes& rank_ones,
    const std::function<SolveStatus(const Points& right, Points* solution)>& solve_rest,
    const Points& b, Points* x) {
  SolveStatus status = solve_rest(b, x);
  if (rank_ones.empty() || status != SolveStatus::kConverged) return status;
  const std::size_t count = rank_ones.size();
  std::vector<Points> Z(count);
  Eigen::MatrixXd inner(count, count);
  Eigen::VectorXd right(count);
  for (std::size_t j = 0; j < count; ++j) {
    Points u = Points::Zero(3, b.cols());
    for (std::size_t k = 0; k < rank_ones[j].nodes.size(); ++k) {
      u.col(rank_ones[j].nodes[k]) = rank_ones[j].a.col(static_cast<Eigen::Index>(k));
    }
    status = solve_rest(u, &Z[j]);
    if (status != SolveStatus::kConverged) return status;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    right[row] = product(rank_ones[i], *x);
    for (std::size_t j = 0; j < count; ++j) {
      const double own = i == j ? 1.0 / rank_ones[i].c : 0.0;
      inner(row, static_cast<Eigen::Index>(j)) = own + product(rank_ones[i], Z[j]);
    }
  }
  const Eigen::VectorXd y = inner.partialPivLu().solve(right);
  for (std::size_t j = 0; j < count; ++j) *x -= y[static_cast<Eigen::Index>(j)] * Z[j];
  return x->allFinite() ? status : SolveStatus::kNonFinite;
}

}  // namespace palpate::solver

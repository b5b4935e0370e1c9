// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "support/random.h"

namespace palpate::springs::least_squares_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

SparseMatrix randomSparse(Eigen::Index rows, Eigen::Index columns, double density,
                          test::Random* random) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index r = 0; r < rows; ++r) {
    for (Eigen::Index c = 0; c < columns; ++c) {
      if (random->uniform(0, 1) < density) entries.emplace_back(r, c, random->uniform(-1, 1));
    }
  }
  SparseMatrix matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Eigen::VectorXd randomVector(Eigen::Index size, test::Random* random) {
  return Eigen::VectorXd::NullaryExpr(size, [&] { return random->uniform(-1, 1); });
}

// Optimal is: what is free has no gradient, what is bound is pressed against its bound.
void expectOptimal(const SparseMatrix& A, const Eigen::VectorXd& b, const Eigen::VectorXd& upper,
                   const Eigen::VectorXd& x) {
  const Eigen::VectorXd slope = A.transpose() * (A * x - b);
  const double size = 1e-8 * b.norm() * A.norm();
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    EXPECT_GE(x[i], 0.0);
    EXPECT_LE(x[i], upper[i]);
    EXPECT_TRUE(x[i] == 0.0 || slope[i] <= size) << i;
    EXPECT_TRUE(x[i] == upper[i] || slope[i] >= -size) << i;
  }
}

TEST(LeastSquares, BoundedSolutionsAreOptimal) {
  test::Random random;
  for (int trial = 0; trial < 30; ++trial) {
    const Eigen::Index n = 5 + 3 * trial;
    const SparseMatrix A = randomSparse(n + 10, n, 0.3, &random);
    const Eigen::VectorXd b = randomVector(n + 10, &random);
    for (const double bound : {kInfinity, 1.0, 0.1, 0.0}) {
      const Eigen::VectorXd upper = Eigen::VectorXd::Constant(n, bound);
      const BoundedSolution solution = boundedLeastSquares(A, b, upper);
      expectOptimal(A, b, upper, solution.x);
      EXPECT_LT(solution.worst_gradient, 1e-9);
    }
  }
}

TEST(LeastSquares, BoundedSolutionsWhereColumnsDependOnEachOther) {
  test::Random random;
  SparseMatrix A = randomSparse(12, 30, 0.4, &random);  // more unknowns than conditions
  const Eigen::VectorXd b = randomVector(12, &random);
  const Eigen::VectorXd upper = Eigen::VectorXd::Constant(30, 0.7);
  const Eigen::VectorXd x = boundedLeastSquares(A, b, upper).x;
  expectOptimal(A, b, upper, x);
  EXPECT_TRUE(x == boundedLeastSquares(A, b, upper).x);  // the same bits
}

TEST(LeastSquares, UnboundedSolutionIsTheUsualOne) {
  test::Random random;
  const SparseMatrix A = randomSparse(40, 15, 0.5, &random);
  const Eigen::VectorXd truth = randomVector(15, &random).cwiseAbs();
  const Eigen::VectorXd b = A * truth;
  const Eigen::VectorXd upper = Eigen::VectorXd::Constant(15, kInfinity);
  EXPECT_LT((boundedLeastSquares(A, b, upper).x - truth).norm(), 1e-7);
}

// Against the null space of C, found by a dense decomposition.
TEST(LeastSquares, EqualitiesAreKept) {
  test::Random random;
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::Index n = 20 + trial;
    const SparseMatrix A = randomSparse(n + 5, n, 0.4, &random);
    const Eigen::VectorXd b = randomVector(n + 5, &random);
    Eigen::MatrixXd rows = randomSparse(8, n, 0.4, &random);
    rows.row(7) = rows.row(0) - 2.0 * rows.row(3);  // the rank is 7
    const SparseMatrix C = rows.sparseView();
    const Eigen::VectorXd x = equalityLeastSquares(A, b, C);
    EXPECT_LT((C * x).cwiseAbs().maxCoeff(), 1e-12);
    const Eigen::MatrixXd Z = Eigen::FullPivLU<Eigen::MatrixXd>(rows).kernel();
    const Eigen::MatrixXd AZ = A * Z;
    const Eigen::VectorXd best = Z * AZ.colPivHouseholderQr().solve(b);
    EXPECT_LT((x - best).norm(), 1e-9 * (1.0 + best.norm()));
  }
}

}  // namespace
}  // namespace palpate::springs::least_squares_test

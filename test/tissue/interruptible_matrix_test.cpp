// SPDX-License-Identifier: GPL-3.0-or-later
// Eigen's BiCGSTAB that can be asked to end.
#include "tissue/methods/prescribed/interruptible_matrix.h"

#include <gtest/gtest.h>

#include <vector>

namespace palpate::tissue::interruptible_matrix_test {
namespace {

using Interruptible = Eigen::BiCGSTAB<InterruptibleMatrix, InterruptibleMatrix::Diagonal>;

// A chain of springs, held at one end: as many iterations as nodes.
Eigen::SparseMatrix<double> chain(int n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 2.0 + 0.01 * i);
    if (i > 0) entries.emplace_back(i, i - 1, -1.0);
    if (i > 0) entries.emplace_back(i - 1, i, -1.0);
  }
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

TEST(InterruptibleMatrix, SolvesToTheBitWhatItsMatrixDoes) {
  const Eigen::SparseMatrix<double> A = chain(200);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(200, -1.0, 2.0);
  Eigen::BiCGSTAB<Eigen::SparseMatrix<double>> plain(A);
  const InterruptibleMatrix matrix(A, nullptr);
  Interruptible interruptible(matrix);
  EXPECT_EQ(interruptible.solve(b).eval(), plain.solve(b).eval());
  EXPECT_EQ(interruptible.iterations(), plain.iterations());
}

TEST(InterruptibleMatrix, EndsWithWhatWasFoundByThen) {
  const Eigen::SparseMatrix<double> A = chain(200);
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(200);
  for (const int in_time : {0, 30}) {
    int asked = 0;
    const solver::Interrupt interrupt = [&] { return ++asked > in_time; };
    const InterruptibleMatrix matrix(A, &interrupt);
    Interruptible solver(matrix);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(200);
    EXPECT_THROW(x = solver.solve(b), InterruptibleMatrix::Interrupted);
    EXPECT_EQ(asked, in_time + 1);

    // Two products an iteration, and one before.
    EXPECT_EQ(matrix.products(), 21 + in_time + 1);
    Eigen::BiCGSTAB<Eigen::SparseMatrix<double>> plain(A);
    plain.setMaxIterations((21 + in_time - 1) / 2);
    EXPECT_EQ(x, plain.solve(b).eval());
    EXPECT_GT((A * x - b).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace palpate::tissue::interruptible_matrix_test

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/base/thread_pool.h"

namespace palpate::bem {

/// Cholesky's factor L of a symmetric positive definite matrix, of which the lower triangle is
/// read, in its place; what is above is left. By tiles, the same bits for any pool; it may be null.
/// False: not positive definite.
bool factorise(Eigen::MatrixXd* A, ThreadPool* pool);

/// X <- L^-1 X.
void solveLower(const Eigen::MatrixXd& L, Eigen::MatrixXd* X, ThreadPool* pool);

/// The lower triangle of S <- S + X^T X.
void addSquare(const Eigen::MatrixXd& X, Eigen::MatrixXd* S, ThreadPool* pool);

}  // namespace palpate::bem

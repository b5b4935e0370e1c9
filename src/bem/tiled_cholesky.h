// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/base/thread_pool.h"

namespace palpate::bem {

/// In-place Cholesky factor L of a symmetric positive definite matrix. Reads and writes the lower
/// triangle only. By tiles, bitwise equal for any pool, which may be null. Returns false if not
/// positive definite.
bool factorise(Eigen::MatrixXd* A, ThreadPool* pool);

/// Computes X <- L^-1 X.
void solveLower(const Eigen::MatrixXd& L, Eigen::MatrixXd* X, ThreadPool* pool);

/// Computes the lower triangle of S <- S + X^T X.
void addSquare(const Eigen::MatrixXd& X, Eigen::MatrixXd* S, ThreadPool* pool);

}  // namespace palpate::bem

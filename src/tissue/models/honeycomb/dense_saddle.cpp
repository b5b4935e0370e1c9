// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense_saddle.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace palpate::tissue {
namespace {

using Row = Eigen::Map<const Eigen::VectorXd>;

constexpr double kGive = 1e-10;  // of the diagonal of C H^-1 C^T

std::ptrdiff_t start(int row, int n) { return static_cast<std::ptrdiff_t>(row) * n; }

// Replaces the lower triangle by its factor.
bool factorize(int n, std::vector<double>* A) {
  for (int i = 0; i < n; ++i) {
    double* row = A->data() + start(i, n);
    for (int j = 0; j <= i; ++j) {
      const double* other = A->data() + start(j, n);
      const double left = row[j] - Row(row, j).dot(Row(other, j));
      if (j < i) {
        row[j] = left / other[j];
      } else if (left > 0.0) {
        row[i] = std::sqrt(left);
      } else {
        return false;
      }
    }
  }
  return true;
}

void solveFactorized(int n, const std::vector<double>& L, double* b) {
  for (int i = 0; i < n; ++i) {
    const double* row = L.data() + start(i, n);
    b[i] = (b[i] - Row(row, i).dot(Row(b, i))) / row[i];
  }
  for (int i = n - 1; i >= 0; --i) {
    const double* row = L.data() + start(i, n);
    b[i] /= row[i];
    Eigen::Map<Eigen::VectorXd>(b, i) -= b[i] * Row(row, i);
  }
}

}  // namespace

void DenseSaddle::reset(int n, int m) {
  n_ = n;
  m_ = m;
  const auto rows = static_cast<std::size_t>(n);
  H_.assign(rows * rows, 0.0);
  C_.assign(rows * static_cast<std::size_t>(m), 0.0);
}

bool DenseSaddle::factor() {
  if (!factorize(n_, &H_)) return false;
  S_.assign(static_cast<std::size_t>(m_) * static_cast<std::size_t>(m_), 0.0);
  row_.resize(static_cast<std::size_t>(n_));
  for (int c = 0; c < m_; ++c) {
    const double* C_c = C_.data() + start(c, n_);
    std::copy(C_c, C_c + n_, row_.begin());
    solveFactorized(n_, H_, row_.data());
    double* row = S_.data() + start(c, m_);
    for (int b = 0; b <= c; ++b) {
      row[b] = Row(C_.data() + start(b, n_), n_).dot(Row(row_.data(), n_));
    }
    row[c] *= 1.0 + kGive;
  }
  return factorize(m_, &S_);
}

double DenseSaddle::solve(const std::vector<double>& g, const std::vector<double>& v,
                          std::vector<double>* y, std::vector<double>* p) {
  *y = g;
  solveFactorized(n_, H_, y->data());
  *p = v;
  for (int c = 0; c < m_; ++c) {
    double& of = (*p)[static_cast<std::size_t>(c)];
    of = Row(C_.data() + start(c, n_), n_).dot(Row(y->data(), n_)) - of;
  }
  solveFactorized(m_, S_, p->data());
  Eigen::Map<Eigen::VectorXd> right(y->data(), n_);
  right = -Row(g.data(), n_);
  for (int c = 0; c < m_; ++c) {
    right += (*p)[static_cast<std::size_t>(c)] * Row(C_.data() + start(c, n_), n_);
  }
  row_ = *y;
  solveFactorized(n_, H_, y->data());
  return -Row(row_.data(), n_).dot(Row(y->data(), n_));
}

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include "palpate/solver/interrupt.h"

namespace palpate::tissue {
class InterruptibleMatrix;
}  // namespace palpate::tissue

namespace Eigen::internal {
template <>
struct traits<palpate::tissue::InterruptibleMatrix> : traits<SparseMatrix<double>> {};
}  // namespace Eigen::internal

namespace palpate::tissue {

/// Reference to a sparse matrix for Eigen's iterative solvers. Its products throw Interrupted at a
/// deadline, after ten iterations at least; the solver's iterate then holds the result so far.
class InterruptibleMatrix : public Eigen::EigenBase<InterruptibleMatrix> {
 public:
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  // NOLINTBEGIN(readability-identifier-naming): what Eigen asks for
  enum {
    ColsAtCompileTime = Eigen::Dynamic,
    MaxColsAtCompileTime = Eigen::Dynamic,
    IsRowMajor = false
  };
  // NOLINTEND(readability-identifier-naming)
  struct Interrupted {};
  /// Jacobi preconditioner.
  struct Diagonal : Eigen::DiagonalPreconditioner<double> {
    using Base = Eigen::DiagonalPreconditioner<double>;
    Diagonal& compute(const InterruptibleMatrix& of) {
      Base::compute(of.A_);
      return *this;
    }
    Diagonal& analyzePattern(const InterruptibleMatrix&) { return *this; }
    Diagonal& factorize(const InterruptibleMatrix& of) { return compute(of); }
  };

  InterruptibleMatrix(const Eigen::SparseMatrix<double>& A, const solver::Interrupt* interrupt)
      : A_(A), interrupt_(interrupt) {}

  Eigen::Index rows() const { return A_.rows(); }
  Eigen::Index cols() const { return A_.cols(); }
  template <class Right>
  Eigen::Product<InterruptibleMatrix, Right, Eigen::AliasFreeProduct> operator*(
      const Eigen::MatrixBase<Right>& right) const {
    return {*this, right.derived()};
  }
  int products() const { return asked_; }
  /// @throws Interrupted
  const Eigen::SparseMatrix<double>& product() const {
    if (++asked_ > kLeast && solver::isInterrupted(interrupt_)) throw Interrupted{};
    return A_;
  }

 private:
  static constexpr int kLeast = 21;  // products: one, and two an iteration

  const Eigen::SparseMatrix<double>& A_;
  mutable int asked_ = 0;
  const solver::Interrupt* interrupt_;
};

}  // namespace palpate::tissue

namespace Eigen::internal {
template <class Right>
struct generic_product_impl<palpate::tissue::InterruptibleMatrix, Right, SparseShape, DenseShape,
                            GemvProduct>
    : generic_product_impl_base<palpate::tissue::InterruptibleMatrix, Right,
                                generic_product_impl<palpate::tissue::InterruptibleMatrix, Right>> {
  template <class Out>
  static void scaleAndAddTo(Out& out, const palpate::tissue::InterruptibleMatrix& A,
                            const Right& right, const double& scale) {
    out.noalias() += scale * (A.product() * right);
  }
};
}  // namespace Eigen::internal

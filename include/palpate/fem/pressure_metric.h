// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

namespace palpate::fem {

/// M in the energy 1/2 c^T M c of the volume changes c [m^3] of pressure nodes; the pressures are M
/// c [Pa]. M is diagonal or the inverse of a sparse matrix.
class PressureMetric {
 public:
  /// M = diag(weights), [Pa/m^3].
  static PressureMetric diagonal(Eigen::VectorXd weights);
  /// M = compliance^-1; `compliance` symmetric positive definite [m^3/Pa].
  static PressureMetric inverseOf(const Eigen::SparseMatrix<double>& compliance);

  /// Block-diagonal metric of several bodies. Diagonal if all are, else the inverse of a
  /// compliance, which is factorised anew. @pre at least one part.
  static PressureMetric sideBySide(const std::vector<const PressureMetric*>& parts);

  Eigen::Index size() const { return weights_.size(); }
  bool isDiagonal() const { return compliance_.size() == 0; }
  /// Computes p = M c.
  void apply(const Eigen::VectorXd& c, Eigen::VectorXd* p) const;

  /// Diagonal of M, or the inverse of the compliance's diagonal, for preconditioners.
  const Eigen::VectorXd& weights() const { return weights_; }
  /// Compliance M^-1 [m^3/Pa]; empty for a diagonal M.
  const Eigen::SparseMatrix<double>& compliance() const { return compliance_; }

 private:
  Eigen::VectorXd weights_;
  Eigen::SparseMatrix<double> compliance_;
  std::shared_ptr<const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>> factor_;
};

}  // namespace palpate::fem

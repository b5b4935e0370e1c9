// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cholmod.h>

#include <memory>
#include <vector>

#include "palpate/fem/stiffness.h"

namespace palpate::solver {

/// A stiffness in CHOLMOD's format: the lower triangle by columns. Built from a first matrix; later
/// ones must have its pattern and couplings.
class CholmodMatrix {
 public:
  virtual ~CholmodMatrix() = default;

  /// Whether A has the couplings of the first matrix.
  virtual bool fits(const fem::Stiffness& A) const = 0;
  /// Matrix for the couplings of A, from this one, which was built without couplings.
  virtual std::unique_ptr<CholmodMatrix> coupled(const fem::Stiffness& A) const = 0;
  /// Sets the values to those of A. @pre fits(A).
  virtual void assign(const fem::Stiffness& A) = 0;
  /// Number of rows beyond the 3 n of the nodes.
  virtual int numPressures() const { return 0; }
  cholmod_sparse* sparse() const { return sparse_; }

 protected:
  explicit CholmodMatrix(cholmod_common* common) : common_(common) {}
  /// Allocates columns with these rows, ascending from the diagonal.
  void allocate(const std::vector<std::vector<int>>& rows);
  double* values() const { return static_cast<double*>(sparse_->x); }
  cholmod_common* common() const { return common_; }

  struct Free {
    cholmod_common* common;
    void operator()(cholmod_sparse* matrix) const { cholmod_free_sparse(&matrix, common); }
  };

 private:
  cholmod_common* common_;
  std::unique_ptr<cholmod_sparse, Free> owner_{nullptr, Free{nullptr}};
  cholmod_sparse* sparse_ = nullptr;
};

/// Whether a matrix contains the volume stiffness.
enum class Volumes { kLeftOut, kIncluded };

/// Volume stiffness with a diagonal metric is assembled into blocks over two rings of elements;
/// other pressures stay unknowns of a quasi-definite system
///     | K  B^T          |
///     | B  -compliance  |   [Vanderbei 1995], which has an LDL^T for every order.
std::unique_ptr<CholmodMatrix> makeCholmodMatrix(const fem::Stiffness& A, Volumes volumes,
                                                 cholmod_common* common);

}  // namespace palpate::solver

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cholmod.h>

#include <memory>
#include <vector>

#include "palpate/fem/stiffness.h"

namespace palpate::solver {

/// A stiffness as CHOLMOD wants it: the lower triangle, column after column. Built from a first
/// matrix; later ones have the same pattern and couple the same nodes.
class CholmodMatrix {
 public:
  virtual ~CholmodMatrix() = default;

  /// Whether A couples the nodes that the first matrix did.
  virtual bool fits(const fem::Stiffness& A) const = 0;
  /// One that fits A, from this one, which was built from a matrix without couplings.
  virtual std::unique_ptr<CholmodMatrix> coupled(const fem::Stiffness& A) const = 0;
  /// Values of A, which fits.
  virtual void assign(const fem::Stiffness& A) = 0;
  /// Rows beyond the 3 n of the nodes.
  virtual int numPressures() const { return 0; }
  cholmod_sparse* sparse() const { return sparse_; }

 protected:
  explicit CholmodMatrix(cholmod_common* common) : common_(common) {}
  /// Columns of `rows` each, ascending from the diagonal on.
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

/// Whether the volumes around pressure nodes are part of a matrix.
enum class Volumes { kLeftOut, kIncluded };

/// Volumes around pressure nodes whose metric is diagonal are assembled into the blocks, over two
/// rings of elements; others stay unknowns of their own, in a quasi-definite system
///     | K  B^T          |
///     | B  -compliance  |   [Vanderbei 1995], which has an LDL^T for every order.
std::unique_ptr<CholmodMatrix> makeCholmodMatrix(const fem::Stiffness& A, Volumes volumes,
                                                 cholmod_common* common);

}  // namespace palpate::solver

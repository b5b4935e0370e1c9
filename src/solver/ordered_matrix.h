// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cholmod.h>

#include <memory>
#include <vector>

namespace palpate::solver {

/// Lower triangle of a symmetric matrix in the order of its factor, reused for later matrices.
/// CHOLMOD would sort each matrix anew by two transpositions, which take as long as the factor for
/// some hundred nodes.
class OrderedMatrix {
 public:
  /// Takes the order of the supernodal `factor` of a matrix with the pattern of `lower`. The factor
  /// then is one of ordered() matrices. @pre `common` outlives this.
  OrderedMatrix(const cholmod_sparse& lower, cholmod_factor* factor, cholmod_common* common);

  /// Ordered matrix of `lower`, which has the pattern of the first.
  cholmod_sparse* ordered(const cholmod_sparse& lower);
  /// Row k of the ordered matrix is row order()[k].
  const std::vector<int>& order() const { return order_; }

 private:
  struct Free {
    cholmod_common* common;
    void operator()(cholmod_sparse* matrix) const { cholmod_free_sparse(&matrix, common); }
  };
  std::vector<int> order_, source_;  // source_: position of each entry in `lower`
  std::unique_ptr<cholmod_sparse, Free> matrix_;
};

}  // namespace palpate::solver

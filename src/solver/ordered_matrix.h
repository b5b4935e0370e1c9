// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cholmod.h>

#include <memory>
#include <vector>

namespace palpate::solver {

/// The lower triangle of a symmetric matrix in the order of its factor, kept from one matrix to the
/// next: CHOLMOD would sort each anew, by two transpositions, which take as long as the factor of a
/// body of some hundred nodes.
class OrderedMatrix {
 public:
  /// Takes the order of `factor`, supernodal, of a matrix with the pattern of `lower`. From here on
  /// the factor is one of what ordered() gives. `common` must outlive this.
  OrderedMatrix(const cholmod_sparse& lower, cholmod_factor* factor, cholmod_common* common);

  /// The matrix of `lower`, which has the pattern of the first.
  cholmod_sparse* ordered(const cholmod_sparse& lower);
  /// Row k of it is row order()[k].
  const std::vector<int>& order() const { return order_; }

 private:
  struct Free {
    cholmod_common* common;
    void operator()(cholmod_sparse* matrix) const { cholmod_free_sparse(&matrix, common); }
  };
  std::vector<int> order_, source_;  // source_: of each entry, in `lower`
  std::unique_ptr<cholmod_sparse, Free> matrix_;
};

}  // namespace palpate::solver

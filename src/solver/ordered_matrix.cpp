// SPDX-License-Identifier: GPL-3.0-or-later
#include "ordered_matrix.h"

#include <algorithm>
#include <numeric>

namespace palpate::solver {

OrderedMatrix::OrderedMatrix(const cholmod_sparse& lower, cholmod_factor* factor,
                             cholmod_common* common)
    : matrix_(nullptr, Free{common}) {
  auto* order = static_cast<int*>(factor->Perm);
  order_.assign(order, order + factor->n);
  // Permutes the entries' positions as values.
  std::vector<double> places(lower.nzmax);
  std::iota(places.begin(), places.end(), 0.0);
  cholmod_sparse numbered = lower;
  numbered.x = places.data();
  constexpr int kWithValues = 1;
  const std::unique_ptr<cholmod_sparse, Free> upper(
      cholmod_ptranspose(&numbered, kWithValues, order, nullptr, 0, common), Free{common});
  matrix_.reset(cholmod_ptranspose(upper.get(), kWithValues, nullptr, nullptr, 0, common));
  const auto* moved = static_cast<const double*>(matrix_->x);
  source_.assign(moved, moved + places.size());
  std::iota(order, order + factor->n, 0);
  factor->ordering = CHOLMOD_NATURAL;
}

cholmod_sparse* OrderedMatrix::ordered(const cholmod_sparse& lower) {
  const auto* values = static_cast<const double*>(lower.x);
  std::transform(source_.begin(), source_.end(), static_cast<double*>(matrix_->x),
                 [values](int place) { return values[place]; });
  return matrix_.get();
}

}  // namespace palpate::solver

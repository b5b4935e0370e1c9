// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/base/types.h"

namespace palpate::fem {

/// Rank-one updates of a symmetric matrix: a sum of few c a a^T, c > 0, each over many nodes, such
/// as the stiffness of a volume. Stored as vectors, since blocks would be dense over the nodes;
/// products use the vectors, and factors are corrected.
class RankOnes {
 public:
  struct Term {
    std::vector<int> nodes;
    Points a;  ///< Vector of each node, 3 x k.
    double c;
  };

  bool empty() const { return count_ == 0; }
  std::size_t size() const { return count_; }
  const Term& operator[](std::size_t k) const { return terms_[k]; }

  Term& add(const std::vector<int>& nodes, const Points& a, double c);
  /// Removes all terms, but keeps their buffers.
  void clear() { count_ = 0; }

  /// Computes y += A x, both 3 x n.
  void addProduct(const Points& x, Points* y) const;
  /// Multiplies all terms by s.
  void scale(double s);
  /// Sets components with free(c, i) == 0 to zero in all terms.
  void constrain(const Eigen::Matrix3Xd& free);

  void save(StateWriter* out) const;
  /// @throws std::invalid_argument for nodes outside [0, num_nodes).
  void restore(StateReader* in, int num_nodes);

 private:
  std::vector<Term> terms_;  // the first count_ are in use
  std::size_t count_ = 0;
};

}  // namespace palpate::fem

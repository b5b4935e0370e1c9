// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/base/types.h"

namespace palpate::fem {

/// Part of a symmetric matrix that is a sum of few c a a^T, c > 0, each over many nodes: what a
/// volume that something resists adds to a stiffness. As blocks each would fill the square of its
/// nodes; so it is kept as it is, applied in two sweeps over them, and a factor of the rest is
/// corrected for it.
class RankOnes {
 public:
  struct Term {
    std::vector<int> nodes;
    Points a;  ///< Of each of them.
    double c;
  };

  bool empty() const { return count_ == 0; }
  std::size_t size() const { return count_; }
  const Term& operator[](std::size_t k) const { return terms_[k]; }

  Term& add(const std::vector<int>& nodes, const Points& a, double c);
  /// Forgets all, but not their memory.
  void clear() { count_ = 0; }

  /// y += A x, both 3 x n.
  void addProduct(const Points& x, Points* y) const;
  /// A *= s.
  void scale(double s);
  /// Rows and columns of components with free(c, i) == 0 become zero.
  void constrain(const Eigen::Matrix3Xd& free);

  void save(StateWriter* out) const;
  /// @throws std::invalid_argument for nodes that are not among `num_nodes`.
  void restore(StateReader* in, int num_nodes);

 private:
  std::vector<Term> terms_;  // of which the first count_ are there
  std::size_t count_ = 0;
};

}  // namespace palpate::fem

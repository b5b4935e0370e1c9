// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "palpate/fem/stiffness.h"

namespace palpate::solver {

/// A stiffness as one matrix of 3 x 3 blocks: its blocks, couplings and, if requested, its volume
/// stiffness, with diagonal metric. The pattern has the couplings of the matrix at construction
/// only, so factors do not depend on earlier matrices.
class GatheredBlocks {
 public:
  GatheredBlocks(const fem::Stiffness& A, bool with_volumes);
  /// Adds the couplings of A to `uncoupled`, cheaper than from scratch.
  GatheredBlocks(const GatheredBlocks& uncoupled, const fem::Stiffness& A);

  /// Whether A has the same couplings.
  bool fits(const fem::Stiffness& A) const { return A.couplings().pairs() == coupled_; }
  const fem::BlockMatrix& pattern(const fem::Stiffness& A) const {
    return wide_ ? own_ : A.blocks();
  }
  /// Sets the upper triangle to the values of A. @pre fits(A).
  const fem::BlockMatrix& gather(const fem::Stiffness& A);

 private:
  void addVolumes(const fem::VolumeStiffness& volume);

  bool with_volumes_, wide_;  // wide: more than A.blocks()
  std::vector<std::pair<int, int>> coupled_;
  fem::BlockMatrix own_;
  std::vector<int> slot_;  // slots in own_ of the pairs of entries of each volume, in order
};

}  // namespace palpate::solver

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "palpate/fem/stiffness.h"

namespace palpate::solver {

/// All of a stiffness that goes into one matrix of 3 x 3 blocks: its blocks, its couplings and, if
/// asked for, its volumes, which must have a diagonal metric. The pattern holds what couples the
/// nodes of the matrix that it was made from, and nothing that earlier ones had, so that a factor
/// depends on its matrix alone.
class GatheredBlocks {
 public:
  GatheredBlocks(const fem::Stiffness& A, bool with_volumes);
  /// `uncoupled` with the couplings of A, for less than from the beginning.
  GatheredBlocks(const GatheredBlocks& uncoupled, const fem::Stiffness& A);

  /// Whether A couples the same nodes.
  bool fits(const fem::Stiffness& A) const { return A.couplings().pairs() == coupled_; }
  const fem::BlockMatrix& pattern(const fem::Stiffness& A) const {
    return wide_ ? own_ : A.blocks();
  }
  /// Its upper triangle has the values of A, which fits.
  const fem::BlockMatrix& gather(const fem::Stiffness& A);

 private:
  void addVolumes(const fem::VolumeStiffness& volume);

  bool with_volumes_, wide_;  // wide: there is more than A.blocks()
  std::vector<std::pair<int, int>> coupled_;
  fem::BlockMatrix own_;
  std::vector<int> slot_;  // in own_, of the pairs of entries of the volumes, one after another
};

}  // namespace palpate::solver

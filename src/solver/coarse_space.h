// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "aligned_vector.h"
#include "coarse_groups.h"
#include "coarse_parts.h"
#include "kernels/pcg_kernels.h"
#include "palpate/base/thread_pool.h"
#include "palpate/fem/stiffness.h"

namespace palpate::solver {

/// A coarse space for conjugate gradients: overlapping groups of neighbouring nodes move as rigid
/// bodies, which couples distant nodes in one iteration [Nicolaides 1987; with rotations Mandel
/// 1993; smooth, by a partition of unity, Sarkis 2002]. With P such motions, the preconditioner is
/// D^-1 + P (P^T A P)^-1 P^T [Toselli, Widlund 2005, sec. 2.5]. A is the matrix at rest: it changes
/// little with deformation, and iterations do not depend on the past.
///
/// Excludes held components, and nodes held by other energies than the elements', for example a
/// touch. Their diagonal blocks are dominant and differ from matrix to matrix.
class CoarseSpace {
 public:
  /// Whether a coarse space pays for nodes at `points`, 3 x n. `lasting`: the body keeps its mesh.
  static bool pays(const Points& points, bool lasting);
  /// `A`: constrained. `points`: nodes, 3 x n, in `nodes` in an order of neighbours. `nodes`,
  /// `kernels` and `pool`, which may be null, must outlive this.
  CoarseSpace(const fem::Stiffness& A, const Points& points, const SliceOrder& nodes,
              const PcgKernels& kernels, ThreadPool* pool = nullptr);

  /// Excludes nodes whose diagonal in A far exceeds the neighbours' part at construction.
  /// `first_node`: the body's first node in A, which may be a matrix of several bodies.
  void leaveOut(const fem::Stiffness& A, int first_node = 0);
  /// Computes P^T r of a chunk's slices.
  void restrictTo(int chunk, int begin, int end, const double* r);
  /// Computes y = (P^T A P)^-1 P^T r after all chunks; returns r . P y.
  double correct();
  /// P y for PcgKernels::direct().
  const PcgCoarse& correction() const { return motion_; }

 private:
  void findHeld(const fem::Stiffness& A);
  void setMask(int node, bool held);
  void invert(const Eigen::MatrixXd& C);

  const SliceOrder& nodes_;
  const PcgKernels& kernels_;
  CoarseGroups groups_;
  CoarseParts parts_;
  int size_, stride_;                    // of the dense matrix
  ThreadPool* pool_;                     // null where threads do not pay
  Points free_;                          // 0 for held components, of each node
  Points limit_;                         // diagonal from which a node counts as held
  std::vector<bool> held_;               // excluded at present
  AlignedVector<float> motions_, mask_;  // layout as in PcgCoarse
  AlignedVector<float> inverse_;         // stride_ x size_
  AlignedVector<float> r_, y_;
  std::vector<double> sums_, total_;  // of each part; of each group
  PcgCoarse motion_{};
};

}  // namespace palpate::solver

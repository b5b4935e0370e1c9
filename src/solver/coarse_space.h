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
/// bodies, so that what is far apart learns of each other in one iteration [Nicolaides 1987; with
/// rotations Mandel 1993; smooth, by a partition of unity, Sarkis 2002]. With P such motions, the
/// preconditioner becomes D^-1 + P (P^T A P)^-1 P^T [Toselli, Widlund 2005, sec. 2.5]. A is the
/// matrix of the body at rest: what a group's surroundings resist hardly changes while a body is
/// bent and squeezed, and no iteration depends on the past.
///
/// Left out are components that are held, and nodes that something beside the elements holds, such
/// as a touch: so stiff that their diagonal block says all, and others in every matrix.
class CoarseSpace {
 public:
  /// Whether it pays for nodes that lie so (3 x n), in a body that is `lasting`, or soon has
  /// another mesh.
  static bool pays(const Points& points, bool lasting);
  /// Of A, constrained. `points`, 3 x n: where nodes are, which follow one another in `nodes` as
  /// neighbours do. `nodes`, `kernels` and `pool`, which may be null, must outlive this.
  CoarseSpace(const fem::Stiffness& A, const Points& points, const SliceOrder& nodes,
              const PcgKernels& kernels, ThreadPool* pool = nullptr);

  /// Leaves out the nodes that A holds much more than their neighbours did when this was built.
  /// `first_node`: where the body's nodes begin in A, which may be a matrix of several.
  void leaveOut(const fem::Stiffness& A, int first_node = 0);
  /// P^T r of a chunk's slices.
  void restrictTo(int chunk, int begin, int end, const double* r);
  /// y = (P^T A P)^-1 P^T r, when all chunks are there; returns r . P y.
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
  ThreadPool* pool_;                     // null where sharing the product does not pay
  Points free_;                          // 0 where a component is held, of each node
  Points limit_;                         // of its diagonal, beyond which a node is held
  std::vector<bool> held_;               // left out now
  AlignedVector<float> motions_, mask_;  // as PcgCoarse has them
  AlignedVector<float> inverse_;         // stride_ x size_
  AlignedVector<float> r_, y_;
  std::vector<double> sums_, total_;  // of each part; of each group
  PcgCoarse motion_{};
};

}  // namespace palpate::solver

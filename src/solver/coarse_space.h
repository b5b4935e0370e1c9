// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "aligned_vector.h"
#include "chunks.h"
#include "kernels/pcg_kernels.h"
#include "palpate/fem/stiffness.h"
#include "sliced_rows.h"

namespace palpate::solver {

/// A coarse space for conjugate gradients: groups of neighbouring nodes move as rigid bodies, so
/// that what is far apart learns of each other in one iteration [Nicolaides 1987; with rotations
/// Mandel 1993]. With P such motions, the preconditioner becomes D^-1 + P (P^T A P)^-1 P^T
/// [Toselli, Widlund 2005, sec. 2.5]. A is the matrix of the body at rest: what a group's
/// surroundings resist hardly changes while a body is bent and squeezed, and no iteration depends
/// on the past.
///
/// Left out are components that are held, and nodes that something beside the elements holds, such
/// as a touch: so stiff that their diagonal block says all, and others in every matrix.
class CoarseSpace {
 public:
  /// Whether it pays for so many nodes.
  static bool pays(Eigen::Index nodes);
  /// `points`, 3 x n: where nodes are, which follow one another in `nodes` as neighbours do.
  /// `nodes` and `kernels` must outlive this.
  CoarseSpace(const Points& points, const SliceOrder& nodes, const PcgKernels& kernels);

  bool ready() const { return ready_; }
  /// Of A, constrained.
  void build(const fem::Stiffness& A);
  /// Leaves out the nodes that A holds much more than their neighbours did when this was built.
  void leaveOut(const fem::Stiffness& A);
  /// P^T r of a chunk's slices.
  void restrictTo(int chunk, int begin, int end, const double* r);
  /// y = (P^T A P)^-1 P^T r, when all chunks are there; returns r . P y.
  double correct();
  /// P y for PcgKernels::direct(); null if not ready().
  const PcgCoarse* correction() const { return ready_ ? &motion_ : nullptr; }

 private:
  using Motions = Eigen::Matrix<double, 3, 6>;  // of a node by those of its group

  int group(int node) const { return nodes_.rank(node) / group_size_; }
  void placeArms(const Points& points);
  void findHeld(const fem::Stiffness& A);
  void setMask(int node, bool held);
  std::vector<Motions> motions() const;
  Eigen::MatrixXd product(const fem::Stiffness& A) const;
  void addVolumes(const fem::VolumeStiffness& volume, const std::vector<Motions>& P,
                  Eigen::MatrixXd* C) const;
  void invert(const Eigen::MatrixXd& C);

  const SliceOrder& nodes_;
  const PcgKernels& kernels_;
  int group_size_, num_groups_;  // nodes
  int size_, stride_;            // of the dense matrix
  bool ready_ = false;
  Points free_;                // 0 where a component is held, of each node
  Points limit_;               // of its diagonal, beyond which a node is held
  std::vector<bool> held_;     // left out now
  AlignedVector<float> mask_;  // this and the next two as PcgCoarse has them
  AlignedVector<float> arm_;
  std::vector<int> second_;
  AlignedVector<float> inverse_;  // stride_ x size_
  AlignedVector<float> r_, y_;
  std::vector<double> partial_, total_;  // sums of each chunk, and over all
  PcgCoarse motion_{};
};

}  // namespace palpate::solver

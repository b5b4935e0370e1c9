// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "kernels/pcg_kernels.h"
#include "palpate/base/thread_pool.h"
#include "palpate/fem/stiffness.h"
#include "sliced_rows.h"

namespace palpate::solver {

/// A stiffness packed for conjugate gradients: single precision, with the inverses of its diagonal
/// blocks. Sums over nodes run over chunks of a fixed size, so that threads never change a bit.
class PcgMatrix {
 public:
  PcgMatrix(ThreadPool* pool, Isa isa) : kernels_(pcgKernels(isa)), pool_(pool) {}

  /// Takes the values of A, and at the first call its pattern. False: a diagonal block is not
  /// positive definite.
  bool assign(const fem::Stiffness& A);

  /// Where the kernels' vectors have the nodes.
  const SliceOrder& nodes() const { return nodes_; }

  /// Ap = A p; returns p . Ap.
  double apply(const PcgVectors& v);
  /// x += alpha p, r -= alpha Ap, z = D^-1 r; gives r . z and r . r.
  void update(double alpha, const PcgVectors& v, double* rz, double* rr);
  /// p = z + beta p.
  void direct(double beta, const PcgVectors& v);

 private:
  void takePattern(const fem::Stiffness& A);
  void takePattern(const fem::VolumeStiffness::Pattern& pattern);
  void packVolumes(const fem::VolumeStiffness& volume);
  bool invertDiagonal(const fem::Stiffness& A);
  PcgVolumes volumes() const;
  void applyMetric();
  /// body(chunk, begin, end) on chunks of `slices` slices.
  template <class Body>
  void forChunks(int slices, const Body& body);

  const PcgKernels& kernels_;
  ThreadPool* pool_;
  SliceOrder nodes_, pressures_;
  SlicedRows blocks_, rows_, columns_;
  std::vector<int> diagonal_;            // where it begins in the values, [slice][lane]
  std::vector<float> inverse_diagonal_;  // as PcgKernels::invert() has it
  std::vector<float> weights_, c_;
  const fem::PressureMetric* metric_ = nullptr;  // null: weights_ are all of it
  double factor_ = 1.0;
  Eigen::VectorXd changes_, metric_times_changes_;  // for a metric that is not diagonal
  std::vector<double> partial_, partial_2_;
};

}  // namespace palpate::solver

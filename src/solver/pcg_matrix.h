// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "kernels/pcg_kernels.h"
#include "packed_rows.h"
#include "palpate/base/thread_pool.h"
#include "palpate/fem/stiffness.h"

namespace palpate::solver {

/// A stiffness packed for conjugate gradients: single precision, with the inverses of its diagonal
/// blocks. Sums over nodes run over chunks of a fixed size, so that threads never change a bit.
class PcgMatrix {
 public:
  PcgMatrix(ThreadPool* pool, Isa isa) : kernels_(pcgKernels(isa)), pool_(pool) {}

  /// Takes the values of A, and at the first call its pattern. False: a diagonal block is not
  /// positive definite.
  bool assign(const fem::Stiffness& A);

  /// Ap = A p; returns p . Ap.
  double apply(const PcgVectors& v);
  /// x += alpha p, r -= alpha Ap, z = D^-1 r; gives r . z and r . r.
  void update(double alpha, const PcgVectors& v, double* rz, double* rr);
  /// p = z + beta p.
  void direct(double beta, const PcgVectors& v);

 private:
  void takePattern(const fem::Stiffness& A);
  void packVolumes(const fem::VolumeStiffness& volume);
  bool invertDiagonal(const fem::Stiffness& A);
  PcgVolumes volumes() const;
  /// body(chunk, begin, end) on chunks of [0, count).
  template <class Body>
  void forChunks(int count, const Body& body);

  const PcgKernels& kernels_;
  ThreadPool* pool_;
  int num_nodes_ = 0, num_pressures_ = 0;
  PackedRows blocks_, rows_, columns_;
  std::vector<float> inverse_diagonal_, weights_, c_;
  const fem::PressureMetric* metric_ = nullptr;  // null: weights_ are all of it
  double factor_ = 1.0;
  Eigen::VectorXd changes_, pressures_;  // for a metric that is not diagonal
  std::vector<double> partial_, partial_2_;
};

}  // namespace palpate::solver

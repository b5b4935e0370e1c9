// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "chunks.h"
#include "coarse_space.h"
#include "kernels/pcg_kernels.h"
#include "palpate/fem/stiffness.h"
#include "pressure_layout.h"
#include "sliced_rows.h"

namespace palpate::solver {

/// A stiffness packed for conjugate gradients: single precision, with the inverses of its diagonal
/// blocks. Sums over nodes run over chunks of a fixed size, so that threads never change a bit.
class PcgMatrix {
 public:
  /// `points`, 3 x n: where the nodes are; empty: they keep their order, without a coarse space.
  PcgMatrix(ThreadPool* pool, Isa isa, Points points)
      : kernels_(pcgKernels(isa)), pool_(pool), chunks_(pool), points_(std::move(points)) {}

  /// For matrices of several bodies side by side, of which each has a PcgMatrix that has taken its
  /// pattern: with their orders, and the coarse spaces that they have by now. They outlive this,
  /// and are not used at the same time.
  PcgMatrix(ThreadPool* pool, Isa isa, const std::vector<PcgMatrix*>& bodies);

  /// Takes the pattern of A.
  void takePattern(const fem::Stiffness& A);
  /// Takes the values of A, and at the first call its pattern if that is not known. `changed`:
  /// slots off the diagonal that alone, with those on it and the couplings, differ from what was
  /// taken last; null: all may. False: a diagonal block is not positive definite.
  bool assign(const fem::Stiffness& A, const std::vector<int>* changed = nullptr);

  /// Of the matrix, all of which a product reads.
  std::size_t bytes() const { return rows_.bytes() + others_.bytes() + columns_.bytes(); }

  /// Where the kernels' vectors have the nodes.
  const SliceOrder& nodes() const { return nodes_; }

  /// Ap = A p; returns p . Ap.
  double apply(const PcgVectors& v);
  /// Whether addCoarse() pays.
  bool wantsCoarse(bool lasting) const { return CoarseSpace::pays(points_, lasting); }
  /// A coarse space from here on, of the body at rest; assign() may leave parts of it out.
  void addCoarse(const fem::Stiffness& A);
  /// r -= alpha Ap, z = D^-1 r, with the correction of the coarse space if there is one; gives
  /// r . z and r . r.
  void update(double alpha, const PcgVectors& v, double* rz, double* rr);
  /// x += alpha p, p = z + beta p.
  void direct(double alpha, double beta, const PcgVectors& v);

 private:
  /// Chunks whose pressures a chunk's nodes belong to.
  struct Reach {
    int first = std::numeric_limits<int>::max(), last = -1;
    bool others = false;  ///< Also some that are not at home.
  };
  /// The nodes of a body, with its coarse space.
  struct Part {
    CoarseSpace* coarse;  ///< Null: none.
    int first_node, first_slice, slices;

    int chunk(int of_all) const { return of_all - first_slice / Chunks::kSlices; }
  };
  /// A block beside the pattern, between nodes that begin there in the vectors.
  struct Coupling {
    std::ptrdiff_t row, column;
    Mat3 values;
  };

  void orderNodes(const fem::BlockMatrix& K);
  const Part& partAt(int slice) const;
  void takeRows(const fem::Stiffness& A);
  void takeVolumes(const fem::BlockMatrix& K, const fem::VolumeStiffness::Pattern& pattern);
  void takeReach(const std::vector<std::vector<SlicedRows::Entry>>& columns);
  void pack(const fem::BlockMatrix& K, const std::vector<int>& changed);
  void packVolumes(const fem::VolumeStiffness& volume);
  bool invertDiagonal(const fem::Stiffness& A);
  PcgVolumes volumes(const float* weights);
  void takeCouplings(const fem::Couplings& couplings);
  void takeRankOnes(const fem::RankOnes& rank_ones);
  /// Ap += their part; returns p . that.
  double addCouplings(const PcgVectors& v) const;
  /// Likewise.
  double addRankOnes(const PcgVectors& v) const;
  /// Ap = K p; returns p . Ap.
  double applyBlocks(const PcgVectors& v);
  /// Ap = K p + B^T M B p; returns p . Ap.
  double applyWithVolumes(const PcgVectors& v);
  void sweep(const PcgVolumes& B, int first, int last, const PcgVectors& v);
  void applyMetric();

  const PcgKernels& kernels_;
  ThreadPool* pool_;
  Chunks chunks_;
  Points points_;
  SliceOrder nodes_;
  PressureLayout pressures_;
  SlicedRows rows_, others_, columns_;     // of K, of B (those not in rows_), of B^T
  std::vector<int> diagonal_;              // where it begins in the values, [slice][lane]
  std::vector<int> place_;                 // in rows_, of each slot
  AlignedVector<float> inverse_diagonal_;  // as PcgKernels::invert() has it
  std::vector<PcgMatrix*> bodies_;         // empty: it is of one
  std::unique_ptr<CoarseSpace> coarse_;
  std::vector<Part> parts_;
  AlignedVector<float> weights_, c_;
  std::vector<Coupling> couplings_;
  /// c a a^T over nodes that begin there in the vectors.
  struct RankOne {
    std::vector<std::ptrdiff_t> nodes;
    Points a;
    double c;
  };
  std::vector<RankOne> rank_ones_;
  std::size_t num_rank_ones_ = 0;                // of them in use
  const fem::PressureMetric* metric_ = nullptr;  // null: weights_ are all of it
  double factor_ = 1.0;
  std::vector<Reach> reach_;                        // of each chunk
  std::vector<char> added_;                         // of each chunk: B^T c is in Ap
  Eigen::VectorXd changes_, metric_times_changes_;  // for a metric that is not diagonal
  std::vector<double> partial_, partial_2_;
};

}  // namespace palpate::solver

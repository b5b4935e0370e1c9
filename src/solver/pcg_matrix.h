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

/// A stiffness packed for conjugate gradients in single precision, with inverse diagonal blocks.
/// Sums over nodes use chunks of fixed size, so results are bitwise independent of threads.
class PcgMatrix {
 public:
  /// `points`: nodes, 3 x n; empty: nodes keep their order, without a coarse space.
  PcgMatrix(ThreadPool* pool, Isa isa, Points points)
      : kernels_(pcgKernels(isa)), pool_(pool), chunks_(pool), points_(std::move(points)) {}

  /// Block-diagonal matrices of several bodies. @pre Each has a PcgMatrix with its pattern, whose
  /// order and present coarse space are used; these outlive this and are not used concurrently.
  PcgMatrix(ThreadPool* pool, Isa isa, const std::vector<PcgMatrix*>& bodies);

  /// Takes the pattern of A.
  void takePattern(const fem::Stiffness& A);
  /// Packs the values of A, and at the first call its pattern. `changed`: off-diagonal slots that
  /// may differ from the last call, in addition to the diagonal and couplings; null: all. Returns
  /// false if a diagonal block is not positive definite.
  bool assign(const fem::Stiffness& A, const std::vector<int>* changed = nullptr);

  /// Size of the matrix data that a product reads.
  std::size_t bytes() const { return rows_.bytes() + others_.bytes() + columns_.bytes(); }

  /// Positions of the nodes in the kernels' vectors.
  const SliceOrder& nodes() const { return nodes_; }

  /// Computes Ap = A p; returns p . Ap.
  double apply(const PcgVectors& v);
  /// Whether addCoarse() pays.
  bool wantsCoarse(bool lasting) const { return CoarseSpace::pays(points_, lasting); }
  /// Adds a coarse space for the body at rest; assign() may exclude nodes of it.
  void addCoarse(const fem::Stiffness& A);
  /// Computes r -= alpha Ap and z = D^-1 r, with the coarse correction if present; gives r . z and
  /// r . r.
  void update(double alpha, const PcgVectors& v, double* rz, double* rr);
  /// Computes x += alpha p and p = z + beta p.
  void direct(double alpha, double beta, const PcgVectors& v);

 private:
  /// Range of chunks with the pressures of a chunk's nodes.
  struct Reach {
    int first = std::numeric_limits<int>::max(), last = -1;
    bool others = false;  ///< Whether pressures without home node are among them.
  };
  /// Nodes of a body, with its coarse space.
  struct Part {
    CoarseSpace* coarse;  ///< May be null.
    int first_node, first_slice, slices;

    int chunk(int of_all) const { return of_all - first_slice / Chunks::kSlices; }
  };
  /// A block outside the pattern, between nodes at these offsets in the vectors.
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
  /// Adds the couplings' part to Ap; returns its product with p.
  double addCouplings(const PcgVectors& v) const;
  /// Adds the rank-one updates' part to Ap; returns its product with p.
  double addRankOnes(const PcgVectors& v) const;
  /// Computes Ap = K p; returns p . Ap.
  double applyBlocks(const PcgVectors& v);
  /// Computes Ap = K p + B^T M B p; returns p . Ap.
  double applyWithVolumes(const PcgVectors& v);
  void sweep(const PcgVolumes& B, int first, int last, const PcgVectors& v);
  void applyMetric();

  const PcgKernels& kernels_;
  ThreadPool* pool_;
  Chunks chunks_;
  Points points_;
  SliceOrder nodes_;
  PressureLayout pressures_;
  SlicedRows rows_, others_, columns_;     // of K, of B (without those in rows_), of B^T
  std::vector<int> diagonal_;              // offset in the values, [slice][lane]
  std::vector<int> place_;                 // position of each slot in rows_
  AlignedVector<float> inverse_diagonal_;  // layout of PcgKernels::invert()
  std::vector<PcgMatrix*> bodies_;         // empty: a single body
  std::unique_ptr<CoarseSpace> coarse_;
  std::vector<Part> parts_;
  AlignedVector<float> weights_, c_;
  std::vector<Coupling> couplings_;
  /// c a a^T over nodes at these offsets in the vectors.
  struct RankOne {
    std::vector<std::ptrdiff_t> nodes;
    Points a;
    double c;
  };
  std::vector<RankOne> rank_ones_;
  std::size_t num_rank_ones_ = 0;                // number in use
  const fem::PressureMetric* metric_ = nullptr;  // null: the metric is diag(weights_)
  double factor_ = 1.0;
  std::vector<Reach> reach_;                        // of each chunk
  std::vector<char> added_;                         // whether each chunk's B^T c is in Ap
  Eigen::VectorXd changes_, metric_times_changes_;  // for a metric that is not diagonal
  std::vector<double> partial_, partial_2_;
};

}  // namespace palpate::solver

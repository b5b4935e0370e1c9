// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/fem/block_matrix.h"
#include "palpate/fem/couplings.h"
#include "palpate/fem/pressure_metric.h"
#include "palpate/fem/rank_ones.h"

namespace palpate::fem {

/// Stiffness B^T M B of nodal pressures; row p of B is the gradient of volume change p. Its
/// assembled pattern would couple two rings of elements. Stored as rows, a product costs about as
/// much as with the elements' matrix.
struct VolumeStiffness {
  struct Pattern {
    std::vector<int> start;  ///< Row p has the entries start[p] .. start[p + 1] - 1.
    std::vector<int> node;   ///< Node of each entry, ascending in a row.
  };
  std::shared_ptr<const Pattern> pattern;
  std::shared_ptr<const PressureMetric> metric;
  Eigen::Matrix3Xd rows;  ///< One column per entry [m^2].
  double factor = 1.0;    ///< Factor of M.

  Eigen::Index numRows() const { return static_cast<Eigen::Index>(pattern->start.size()) - 1; }
  /// Computes c = B x, x 3 x n.
  void multiplyRows(const Points& x, Eigen::VectorXd* c) const;
  /// Computes y += B^T p, 3 x n.
  void addTransposed(const Eigen::VectorXd& p, Points* y) const;
};

/// Symmetric stiffness of a body: 3 x 3 blocks and, for elements with nodal pressures, a
/// VolumeStiffness, both of fixed pattern; couplings between unconnected nodes, and rank-one
/// updates.
class Stiffness {
 public:
  Stiffness() = default;
  explicit Stiffness(BlockMatrix pattern) : blocks_(std::move(pattern)) {}
  /// The rows of `volume` are set to zero.
  Stiffness(BlockMatrix pattern, VolumeStiffness volume);
  /// Block-diagonal stiffness with the patterns of `parts`, in their order, all zero.
  static Stiffness sideBySide(const std::vector<const Stiffness*>& parts);

  int numNodes() const { return blocks_.numNodes(); }
  BlockMatrix& blocks() { return blocks_; }
  const BlockMatrix& blocks() const { return blocks_; }
  bool hasVolume() const { return volume_.pattern != nullptr; }
  VolumeStiffness& volume() { return volume_; }
  const VolumeStiffness& volume() const { return volume_; }
  const Couplings& couplings() const { return couplings_; }
  const RankOnes& rankOnes() const { return rank_ones_; }

  /// Map from the nodes of one or two bodies to those of a group: node i is `first` + i, and from
  /// `split` on `second` + i - split.
  struct NodeMap {
    int first = 0, split = std::numeric_limits<int>::max(), second = 0;

    int of(int i) const { return i < split ? first + i : second + i - split; }
  };
  /// Sets the map for all later add() calls.
  void setNodeMap(const NodeMap& node_map) { node_map_ = node_map; }
  /// += w I on the diagonal block of node i.
  void addToDiagonal(int i, double w) {
    blocks_.block(blocks_.diagonal(node_map_.of(i))).diagonal().array() += w;
  }
  /// += M on block (i, j), or a coupling where the pattern has none.
  /// @pre The caller adds the transpose to (j, i).
  void add(int i, int j, const Mat3& M) {
    i = node_map_.of(i);
    j = node_map_.of(j);
    const int slot = blocks_.find(i, j);
    if (slot < 0) return couplings_.add(i, j, M);
    blocks_.addTo(slot, i, j, M);
  }
  /// += H, dense, symmetric, 3 k x 3 k, over `nodes`, k of them.
  void add(const Eigen::Ref<const Eigen::VectorXi>& nodes,
           const Eigen::Ref<const Eigen::MatrixXd>& H);
  /// Adds the rank-one update c a a^T, c > 0, `a` 3 x k over k `nodes`.
  void addRankOne(const std::vector<int>& nodes, const Points& a, double c) {
    for (int& i : rank_ones_.add(nodes, a, c).nodes) i = node_map_.of(i);
  }
  /// Adds H of the point sum_a weights[a] x[nodes[a]], by weights[a] weights[b] H to blocks (a, b).
  template <int k>
  void addPoint(const Eigen::Matrix<int, k, 1>& nodes, const Eigen::Matrix<double, k, 1>& weights,
                const Mat3& H) {
    for (Eigen::Index a = 0; a < nodes.size(); ++a) {
      for (Eigen::Index b = 0; b < nodes.size(); ++b) {
        const double w = weights[a] * weights[b];
        if (w != 0.0) add(nodes[a], nodes[b], w * H);
      }
    }
  }
  /// Clears couplings, rank-one updates and the record of add() after the blocks were overwritten.
  void forgetAdded() {
    blocks_.forgetAdded();
    couplings_.clear();
    rank_ones_.clear();
  }
  void setZero();

  /// Computes y = K x, both 3 x n.
  void multiply(const Points& x, Points* y) const;
  /// Multiplies K by s.
  void scale(double s);
  /// Diagonal blocks (i, i) of K without rank-one updates; approximate for a metric that is not
  /// diagonal.
  void diagonal(std::vector<Mat3>* blocks) const;
  /// As BlockMatrix::constrain().
  void constrain(const Eigen::Matrix3Xd& free);
  /// BlockMatrix::constrain() of all parts but the volume stiffness.
  void constrainBlocks(const Eigen::Matrix3Xd& free) {
    blocks_.constrain(free);
    couplings_.constrain(free);
    rank_ones_.constrain(free);
  }

  void save(StateWriter* out) const;
  /// @throws std::invalid_argument for a different pattern.
  void restore(StateReader* in);

 private:
  BlockMatrix blocks_;
  VolumeStiffness volume_;
  Couplings couplings_;
  NodeMap node_map_;
  RankOnes rank_ones_;
};

}  // namespace palpate::fem

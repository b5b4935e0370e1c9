// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "palpate/fem/block_matrix.h"
#include "palpate/fem/pressure_metric.h"

namespace palpate::fem {

/// The stiffness that the volumes around pressure nodes add to a body: B^T M B, of which row p of B
/// is the gradient of volume change p. Its assembled pattern would reach over two rings of
/// elements; kept as rows, it is applied for about the price of the elements' own matrix.
struct VolumeStiffness {
  struct Pattern {
    std::vector<int> start;  ///< Row p has the entries start[p] .. start[p + 1].
    std::vector<int> node;   ///< Of each entry, ascending in a row.
  };
  std::shared_ptr<const Pattern> pattern;
  std::shared_ptr<const PressureMetric> metric;
  Eigen::Matrix3Xd rows;  ///< One column an entry [m^2].
  double factor = 1.0;    ///< Multiplies M.

  Eigen::Index numRows() const { return static_cast<Eigen::Index>(pattern->start.size()) - 1; }
};

/// Symmetric stiffness matrix of a body: 3 x 3 blocks and, for elements with nodal pressures,
/// a VolumeStiffness. The pattern never changes.
class Stiffness {
 public:
  Stiffness() = default;
  explicit Stiffness(BlockMatrix pattern) : blocks_(std::move(pattern)) {}
  /// `volume` without rows yet: they are set to zero.
  Stiffness(BlockMatrix pattern, VolumeStiffness volume);

  int numNodes() const { return blocks_.numNodes(); }
  BlockMatrix& blocks() { return blocks_; }
  const BlockMatrix& blocks() const { return blocks_; }
  bool hasVolume() const { return volume_.pattern != nullptr; }
  VolumeStiffness& volume() { return volume_; }
  const VolumeStiffness& volume() const { return volume_; }

  /// y = K x, both 3 x n.
  void multiply(const Points& x, Points* y) const;
  /// K *= s.
  void scale(double s);
  /// Diagonal blocks (i, i) of K; with a metric that is not diagonal an approximation.
  void diagonal(std::vector<Mat3>* blocks) const;
  /// As BlockMatrix::constrain().
  void constrain(const Eigen::Matrix3Xd& free);

 private:
  BlockMatrix blocks_;
  VolumeStiffness volume_;
};

}  // namespace palpate::fem

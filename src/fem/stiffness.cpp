// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/stiffness.h"

namespace palpate::fem {

Stiffness::Stiffness(BlockMatrix pattern, VolumeStiffness volume)
    : blocks_(std::move(pattern)), volume_(std::move(volume)) {
  volume_.rows.setZero(3, static_cast<Eigen::Index>(volume_.pattern->node.size()));
}

void Stiffness::multiply(const Points& x, Points* y) const {
  blocks_.multiply(x, y);
  if (!hasVolume()) return;
  const std::vector<int>& start = volume_.pattern->start;
  const std::vector<int>& node = volume_.pattern->node;
  const Eigen::Index num_rows = volume_.numRows();
  Eigen::VectorXd c(num_rows);
  for (Eigen::Index p = 0; p < num_rows; ++p) {
    double sum = 0.0;
    for (int k = start[p]; k < start[p + 1]; ++k) sum += volume_.rows.col(k).dot(x.col(node[k]));
    c[p] = sum;
  }
  c = volume_.factor * volume_.metric->apply(c);
  for (Eigen::Index p = 0; p < num_rows; ++p) {
    for (int k = start[p]; k < start[p + 1]; ++k) y->col(node[k]) += c[p] * volume_.rows.col(k);
  }
}

void Stiffness::scale(double s) {
  blocks_.scale(s);
  volume_.factor *= s;
}

void Stiffness::diagonal(std::vector<Mat3>* blocks) const {
  blocks->resize(static_cast<std::size_t>(numNodes()));
  for (int i = 0; i < numNodes(); ++i) (*blocks)[i] = blocks_.block(blocks_.diagonal(i));
  if (!hasVolume()) return;
  for (Eigen::Index p = 0; p < volume_.numRows(); ++p) {
    const double weight = volume_.factor * volume_.metric->weights()[p];
    for (int k = volume_.pattern->start[p]; k < volume_.pattern->start[p + 1]; ++k) {
      const Vec3 b = volume_.rows.col(k);
      (*blocks)[volume_.pattern->node[k]] += weight * b * b.transpose();
    }
  }
}

void Stiffness::constrain(const Eigen::Matrix3Xd& free) {
  blocks_.constrain(free);
  if (!hasVolume()) return;
  for (std::size_t k = 0; k < volume_.pattern->node.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    volume_.rows.col(column).array() *= free.col(volume_.pattern->node[k]).array();
  }
}

}  // namespace palpate::fem

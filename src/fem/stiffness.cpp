// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/stiffness.h"

#include <algorithm>

namespace palpate::fem {

void VolumeStiffness::multiplyRows(const Points& x, Eigen::VectorXd* c) const {
  c->resize(numRows());
  for (Eigen::Index n = 0; n < numRows(); ++n) {
    double sum = 0.0;
    for (int k = pattern->start[n]; k < pattern->start[n + 1]; ++k) {
      sum += rows.col(k).dot(x.col(pattern->node[k]));
    }
    (*c)[n] = sum;
  }
}

void VolumeStiffness::addTransposed(const Eigen::VectorXd& p, Points* y) const {
  for (Eigen::Index n = 0; n < numRows(); ++n) {
    for (int k = pattern->start[n]; k < pattern->start[n + 1]; ++k) {
      y->col(pattern->node[k]) += p[n] * rows.col(k);
    }
  }
}

Stiffness::Stiffness(BlockMatrix pattern, VolumeStiffness volume)
    : blocks_(std::move(pattern)), volume_(std::move(volume)) {
  volume_.rows.setZero(3, static_cast<Eigen::Index>(volume_.pattern->node.size()));
}

Stiffness Stiffness::sideBySide(const std::vector<const Stiffness*>& parts) {
  std::vector<const BlockMatrix*> blocks;
  blocks.reserve(parts.size());
  std::vector<const PressureMetric*> metrics;
  auto pattern = std::make_shared<VolumeStiffness::Pattern>();
  pattern->start = {0};
  int first = 0;
  for (const Stiffness* part : parts) {
    blocks.push_back(&part->blocks_);
    if (part->hasVolume()) {
      metrics.push_back(part->volume_.metric.get());
      const VolumeStiffness::Pattern& own = *part->volume_.pattern;
      const int entries = pattern->start.back();
      for (std::size_t p = 1; p < own.start.size(); ++p) {
        pattern->start.push_back(entries + own.start[p]);
      }
      for (int node : own.node) pattern->node.push_back(first + node);
    }
    first += part->numNodes();
  }
  if (metrics.empty()) return Stiffness(BlockMatrix::sideBySide(blocks));
  VolumeStiffness volume;
  volume.pattern = pattern;
  volume.metric = std::make_shared<const PressureMetric>(PressureMetric::sideBySide(metrics));
  return {BlockMatrix::sideBySide(blocks), std::move(volume)};
}

void Stiffness::add(const Eigen::Ref<const Eigen::VectorXi>& nodes,
                    const Eigen::Ref<const Eigen::MatrixXd>& H) {
  for (Eigen::Index a = 0; a < nodes.size(); ++a) {
    for (Eigen::Index b = 0; b < nodes.size(); ++b) {
      add(nodes[a], nodes[b], H.block<3, 3>(3 * a, 3 * b));
    }
  }
}

void Stiffness::setZero() {
  blocks_.setZero();
  if (hasVolume()) volume_.rows.setZero();
  couplings_.clear();
  rank_ones_.clear();
}

void Stiffness::multiply(const Points& x, Points* y) const {
  blocks_.multiply(x, y);
  couplings_.addProduct(x, y);
  rank_ones_.addProduct(x, y);
  if (!hasVolume()) return;
  Eigen::VectorXd c, p;
  volume_.multiplyRows(x, &c);
  volume_.metric->apply(c, &p);
  p *= volume_.factor;
  volume_.addTransposed(p, y);
}

void Stiffness::scale(double s) {
  blocks_.scale(s);
  couplings_.scale(s);
  rank_ones_.scale(s);
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
  constrainBlocks(free);
  if (!hasVolume()) return;
  const std::vector<int>& node = volume_.pattern->node;
  for (std::size_t k = 0; k < node.size(); ++k) {
    const double* mask = free.data() + 3 * static_cast<std::ptrdiff_t>(node[k]);
    if (mask[0] * mask[1] * mask[2] == 1.0) continue;
    for (int c = 0; c < 3; ++c) volume_.rows(c, static_cast<Eigen::Index>(k)) *= mask[c];
  }
}

void Stiffness::save(StateWriter* out) const {
  using Values = Eigen::Matrix<double, 9, Eigen::Dynamic>;
  const Values values = Eigen::Map<const Values>(blocks_.values(), 9, blocks_.numBlocks());
  out->put(values);
  out->put(volume_.rows);
  out->put(volume_.factor);
  out->put(static_cast<std::int64_t>(couplings_.blocks().size()));
  for (const Couplings::Block& block : couplings_.blocks()) {
    out->put(block.i);
    out->put(block.j);
    out->put(block.values);
  }
  rank_ones_.save(out);
}

void Stiffness::restore(StateReader* in) {
  Eigen::Matrix<double, 9, Eigen::Dynamic> values(9, blocks_.numBlocks());
  in->getSame(&values);
  std::copy(values.data(), values.data() + values.size(), blocks_.values());
  in->getSame(&volume_.rows);
  in->get(&volume_.factor);
  couplings_.clear();
  for (std::int64_t k = in->count(sizeof(Mat3)); k > 0; --k) {
    int i = 0, j = 0;
    Mat3 block;
    in->get(&i);
    in->get(&j);
    in->get(&block);
    if (i < 0 || j < 0 || i >= numNodes() || j >= numNodes()) StateReader::fail();
    couplings_.add(i, j, block);
  }
  rank_ones_.restore(in, numNodes());
}

}  // namespace palpate::fem

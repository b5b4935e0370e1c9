// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarse_space.h"

#include <algorithm>
#include <limits>

namespace palpate::solver {
namespace {

// Nodes. With fewer the iterations that it spares are worth little more than its own work, and the
// building of it would hold up meshes that adapt.
constexpr int kFewest = 3500;
// Nodes of a group at least, and groups at most: the dense matrix is six times as large.
constexpr int kSmallestGroup = 128, kMostGroups = 128;
// How many times more than its neighbours something else holds a node that is left out.
constexpr double kHeld = 4.0, kNoLimit = std::numeric_limits<double>::infinity();

constexpr int kSumsOfAChunk = 12;
static_assert(kWindow == kSlice * Chunks::kSlices && kWindow == 2 * kSmallestGroup);

int groupSize(int nodes) {
  int size = kSmallestGroup;
  while ((nodes + size - 1) / size > kMostGroups) size *= 2;
  return size;
}

}  // namespace

bool CoarseSpace::pays(Eigen::Index nodes) { return nodes >= kFewest; }

CoarseSpace::CoarseSpace(const Points& points, const SliceOrder& nodes, const PcgKernels& kernels)
    : nodes_(nodes),
      kernels_(kernels),
      group_size_(groupSize(nodes.count())),
      num_groups_((nodes.count() + group_size_ - 1) / group_size_),
      size_(6 * num_groups_),
      stride_((size_ + kDenseRows - 1) / kDenseRows * kDenseRows),
      free_(Points::Ones(3, nodes.count())),
      limit_(Points::Zero(3, nodes.count())),
      held_(static_cast<std::size_t>(nodes.count()), false) {
  const std::size_t lanes = static_cast<std::size_t>(kSlice) * nodes.numSlices();
  second_.assign(lanes, 0);
  mask_.assign(3 * lanes, 0.0F);
  arm_ = mask_;
  r_.assign(static_cast<std::size_t>(stride_) + 6, 0.0F);  // kernels look at one group more
  y_ = r_;
  total_.resize(static_cast<std::size_t>(size_));
  partial_.resize(kSumsOfAChunk * static_cast<std::size_t>(Chunks::number(nodes.numSlices())));
  placeArms(points);
  motion_ = {group_size_, mask_.data(), arm_.data(), second_.data(), y_.data()};
}

// From the middle of each group, in units of its size.
void CoarseSpace::placeArms(const Points& points) {
  Points middle = Points::Zero(3, num_groups_);
  Eigen::VectorXd count = Eigen::VectorXd::Zero(num_groups_), size = count;
  for (int i = 0; i < nodes_.count(); ++i) {
    middle.col(group(i)) += points.col(i);
    count[group(i)] += 1.0;
  }
  middle *= count.cwiseInverse().asDiagonal();
  for (int i = 0; i < nodes_.count(); ++i) {
    size[group(i)] = std::max(size[group(i)], (points.col(i) - middle.col(group(i))).norm());
  }
  for (int i = 0; i < nodes_.count(); ++i) {
    const int g = group(i);
    if (!(size[g] > 0.0)) continue;
    const Vec3 arm = (points.col(i) - middle.col(g)) / size[g];
    for (int c = 0; c < 3; ++c) {
      arm_[nodes_.offset(i, 3) + kSlice * c] = static_cast<float>(arm[c]);
    }
    second_[nodes_.position(i)] = group_size_ < kWindow ? g % 2 : 0;
  }
}

void CoarseSpace::build(const fem::Stiffness& A) {
  findHeld(A);
  invert(product(A));
  ready_ = true;
}

// What a node has on its diagonal from its neighbours is what vanishes when all of them are shifted
// with it: minus the sum of the blocks beside the diagonal.
void CoarseSpace::findHeld(const fem::Stiffness& A) {
  const fem::BlockMatrix& K = A.blocks();
  for (int i = 0; i < K.numNodes(); ++i) {
    Vec3 others = Vec3::Zero(), shared = Vec3::Zero();
    for (int slot = K.rowBegin(i); slot < K.rowEnd(i); ++slot) {
      if (slot == K.diagonal(i)) continue;
      others += K.block(slot).cwiseAbs().rowwise().sum();
      shared -= K.block(slot).diagonal();
    }
    for (int c = 0; c < 3; ++c) {
      free_(c, i) = others[c] > 0.0 ? 1.0 : 0.0;
      limit_(c, i) = others[c] > 0.0 ? (1.0 + kHeld) * shared[c] : kNoLimit;
    }
    setMask(i, false);
  }
  leaveOut(A);
}

void CoarseSpace::setMask(int node, bool held) {
  held_[node] = held;
  float* mask = mask_.data() + nodes_.offset(node, 3);
  for (int c = 0; c < 3; ++c) mask[kSlice * c] = held ? 0.0F : static_cast<float>(free_(c, node));
}

void CoarseSpace::leaveOut(const fem::Stiffness& A) {
  const fem::BlockMatrix& K = A.blocks();
  for (int i = 0; i < K.numNodes(); ++i) {
    const double* block = K.values() + 9 * static_cast<std::ptrdiff_t>(K.diagonal(i));
    const double* limit = limit_.data() + 3 * static_cast<std::ptrdiff_t>(i);
    const bool held = block[0] > limit[0] || block[4] > limit[1] || block[8] > limit[2];
    if (held != held_[i]) setMask(i, held);
  }
}

std::vector<CoarseSpace::Motions> CoarseSpace::motions() const {
  std::vector<Motions> P(held_.size(), Motions::Zero());
  for (int i = 0; i < nodes_.count(); ++i) {
    if (held_[i]) continue;
    const float* arm = arm_.data() + nodes_.offset(i, 3);
    const Vec3 d(arm[0], arm[kSlice], arm[2 * kSlice]);
    P[i].leftCols<3>().setIdentity();
    for (int c = 0; c < 3; ++c) P[i].col(3 + c) = Vec3::Unit(c).cross(d);
    P[i] = free_.col(i).asDiagonal() * P[i];
  }
  return P;
}

Eigen::MatrixXd CoarseSpace::product(const fem::Stiffness& A) const {
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(size_, size_);
  const fem::BlockMatrix& K = A.blocks();
  const std::vector<Motions> P = motions();
  for (int i = 0; i < K.numNodes(); ++i) {
    for (int slot = K.rowBegin(i); slot < K.rowEnd(i); ++slot) {
      const int j = K.column(slot), a = group(i), b = group(j);
      if (a > b) continue;
      const Motions AP = K.block(slot) * P[j];
      C.block<6, 6>(6 * a, 6 * b).noalias() += P[i].transpose() * AP;
    }
  }
  if (A.hasVolume()) addVolumes(A.volume(), P, &C);
  return C.selfadjointView<Eigen::Upper>();
}

// P^T B^T M B P, with M's diagonal only.
void CoarseSpace::addVolumes(const fem::VolumeStiffness& volume, const std::vector<Motions>& P,
                             Eigen::MatrixXd* C) const {
  using Row = Eigen::Matrix<double, 6, 1>;
  const fem::VolumeStiffness::Pattern& pattern = *volume.pattern;
  Eigen::Matrix<double, 6, Eigen::Dynamic> sums(6, num_groups_);
  sums.setZero();
  std::vector<int> reached;
  for (int p = 0; p < static_cast<int>(volume.numRows()); ++p) {
    reached.clear();
    for (int k = pattern.start[p]; k < pattern.start[p + 1]; ++k) {
      const int a = group(pattern.node[k]);
      if (std::find(reached.begin(), reached.end(), a) == reached.end()) reached.push_back(a);
      sums.col(a) += P[pattern.node[k]].transpose() * volume.rows.col(k);
    }
    const double weight = volume.factor * volume.metric->weights()[p];
    for (const int a : reached) {
      const Row of_a = weight * sums.col(a);
      for (const int b : reached) {
        if (a <= b) C->block<6, 6>(6 * a, 6 * b).noalias() += of_a * sums.col(b).transpose();
      }
    }
    for (const int a : reached) sums.col(a).setZero();
  }
}

void CoarseSpace::invert(const Eigen::MatrixXd& C) {
  AlignedVector<double> A(static_cast<std::size_t>(stride_) * size_, 0.0);
  for (int j = 0; j < size_; ++j) std::copy_n(C.col(j).data(), size_, A.data() + stride_ * j);
  kernels_.invertDense(size_, stride_, A.data());
  inverse_.resize(A.size());
  std::transform(A.begin(), A.end(), inverse_.begin(),
                 [](double a) { return static_cast<float>(a); });
}

void CoarseSpace::restrictTo(int chunk, int begin, int end, const double* r) {
  kernels_.restrictTo(motion_, begin, end, r,
                      partial_.data() + kSumsOfAChunk * static_cast<std::ptrdiff_t>(chunk));
}

double CoarseSpace::correct() {
  std::fill(total_.begin(), total_.end(), 0.0);
  for (int chunk = 0; chunk < Chunks::number(nodes_.numSlices()); ++chunk) {
    const double* sums = partial_.data() + kSumsOfAChunk * static_cast<std::ptrdiff_t>(chunk);
    const int first = 6 * (kWindow * chunk / group_size_);
    const int count = group_size_ < kWindow ? std::min(kSumsOfAChunk, size_ - first) : 6;
    for (int k = 0; k < count; ++k) total_[first + k] += sums[k];
  }
  std::transform(total_.begin(), total_.end(), r_.begin(),
                 [](double sum) { return static_cast<float>(sum); });
  kernels_.multiplyDense(inverse_.data(), size_, stride_, r_.data(), y_.data());
  double product = 0.0;
  for (int k = 0; k < size_; ++k) product += static_cast<double>(r_[k]) * y_[k];
  return product;
}

}  // namespace palpate::solver

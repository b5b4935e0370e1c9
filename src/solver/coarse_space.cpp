// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarse_space.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "coarse_matrix.h"
#include "palpate/base/for_all.h"

namespace palpate::solver {
namespace {

// Least number of nodes along the body's longest side. Information crosses the body in as many
// iterations; for fewer, the iterations saved cost less than the coarse space. The second bound is
// for a mesh that is soon replaced.
constexpr double kFewestAlong = 12.0, kFewestAlongForNow = 30.0;
// Least nodes per group, and most groups: the dense matrix has six rows per group and should fit
// into the second-level cache.
constexpr int kSmallestGroup = 64, kMostGroups = 64;
// Excess of the diagonal over the neighbours' part from which a node counts as held.
constexpr double kHeld = 4.0, kNoLimit = std::numeric_limits<double>::infinity();

constexpr int kWorthThreads = 192;  // least rows of the dense matrix for threads

// Estimate for evenly spaced nodes in a box.
double nodesAlong(const Points& points) {
  if (points.cols() < kSmallestGroup) return 0.0;
  const Points d = points.colwise() - Vec3(points.rowwise().mean());
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(d * d.transpose(), Eigen::EigenvaluesOnly);
  const Vec3 sides = axes.eigenvalues().cwiseMax(1e-12 * axes.eigenvalues()[2]).cwiseSqrt();
  return std::cbrt(sides[2] * sides[2] / (sides[0] * sides[1]) *
                   static_cast<double>(points.cols()));
}

int groupSize(int nodes) {
  return std::max(kSmallestGroup, (nodes + kMostGroups - 1) / kMostGroups);
}

}  // namespace

bool CoarseSpace::pays(const Points& points, bool lasting) {
  return nodesAlong(points) >= (lasting ? kFewestAlong : kFewestAlongForNow);
}

CoarseSpace::CoarseSpace(const fem::Stiffness& A, const Points& points, const SliceOrder& nodes,
                         const PcgKernels& kernels, ThreadPool* pool)
    : nodes_(nodes),
      kernels_(kernels),
      groups_(points, nodes, groupSize(nodes.count())),
      parts_(groups_, points, nodes),
      size_(6 * groups_.count()),
      stride_((size_ + kDenseRows - 1) / kDenseRows * kDenseRows),
      pool_(stride_ >= kWorthThreads ? pool : nullptr),
      free_(Points::Ones(3, nodes.count())),
      limit_(Points::Zero(3, nodes.count())),
      held_(static_cast<std::size_t>(nodes.count()), false) {
  mask_.assign(static_cast<std::size_t>(3 * kSlice) * nodes.numSlices(), 0.0F);
  r_.assign(static_cast<std::size_t>(stride_), 0.0F);
  y_ = r_;
  total_.resize(static_cast<std::size_t>(size_));
  sums_.resize(6 * parts_.part.size());
  motions_.resize(sums_.size());
  motion_ = {parts_.of_window.data(),
             parts_.pieces.data(),
             parts_.slice.data(),
             parts_.weights.data(),
             motions_.data(),
             parts_.of_slice.data(),
             parts_.piece_of_slice.data(),
             parts_.part_of_slice.data(),
             mask_.data(),
             parts_.arm.data()};
  findHeld(A);
  Points moving = free_;
  for (int i = 0; i < nodes_.count(); ++i) {
    if (held_[i]) moving.col(i).setZero();
  }
  invert(coarseMatrix(A, groups_, points, moving, kernels_));
}

// The neighbours' part of a node's diagonal vanishes for common translations, so it is minus the
// sum of the off-diagonal blocks.
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

void CoarseSpace::leaveOut(const fem::Stiffness& A, int first_node) {
  const fem::BlockMatrix& K = A.blocks();
  for (int i = 0; i < nodes_.count(); ++i) {
    const double* block = K.values() + 9 * static_cast<std::ptrdiff_t>(K.diagonal(first_node + i));
    const double* limit = limit_.data() + 3 * static_cast<std::ptrdiff_t>(i);
    const bool held = block[0] > limit[0] || block[4] > limit[1] || block[8] > limit[2];
    if (held != held_[i]) setMask(i, held);
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
                      sums_.data() + 6 * static_cast<std::ptrdiff_t>(parts_.of_window[chunk]));
}

double CoarseSpace::correct() {
  std::fill(total_.begin(), total_.end(), 0.0);
  for (std::size_t k = 0; k < parts_.part.size(); ++k) {
    const CoarseParts::Part& part = parts_.part[k];
    const Eigen::Map<const Vec3> force(&sums_[6 * k]), torque(&sums_[6 * k + 3]);
    Eigen::Map<Vec3>(&total_[6 * part.group]) += force;
    Eigen::Map<Vec3>(&total_[6 * part.group + 3]) += part.scale * torque + part.shift.cross(force);
  }
  std::transform(total_.begin(), total_.end(), r_.begin(),
                 [](double sum) { return static_cast<float>(sum); });
  forAll(pool_, static_cast<std::size_t>(stride_ / kDenseRows),
         [&](std::size_t begin, std::size_t end) {
           kernels_.multiplyDense(inverse_.data(), size_, stride_,
                                  kDenseRows * static_cast<int>(begin),
                                  kDenseRows * static_cast<int>(end), r_.data(), y_.data());
         });
  double product = 0.0;
  for (int k = 0; k < size_; ++k) product += static_cast<double>(r_[k]) * y_[k];
  for (std::size_t k = 0; k < parts_.part.size(); ++k) {
    const CoarseParts::Part& part = parts_.part[k];
    const float* t = &y_[6 * part.group];
    const Vec3 w = Eigen::Map<const Eigen::Vector3f>(t + 3).cast<double>();
    const Vec3 shifted = w.cross(part.shift);
    for (int c = 0; c < 3; ++c) {
      motions_[6 * k + c] = t[c] + static_cast<float>(shifted[c]);
      motions_[6 * k + 3 + c] = static_cast<float>(part.scale * w[c]);
    }
  }
  return product;
}

}  // namespace palpate::solver

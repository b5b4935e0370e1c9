// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarse_matrix.h"

#include <vector>

#include "aligned_vector.h"

namespace palpate::solver {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;

// e_c x d: motion of a point at d due to unit rotations.
Mat3 turns(const Vec3& d) {
  Mat3 columns;
  for (int c = 0; c < 3; ++c) columns.col(c) = Vec3::Unit(c).cross(d);
  return columns;
}

// Motions of groups expressed by motions about the points' centre, in units of their extent.
class CommonMotions {
 public:
  CommonMotions(const Points& points, const Points& moving)
      : middle_(points.rowwise().mean()),
        unit_((points.colwise() - middle_).colwise().norm().maxCoeff()),
        motions_(static_cast<std::size_t>(3 * kMotions) * points.cols(), 0.0) {
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const Mat3 turned = turns((points.col(i) - middle_) / unit_);
      for (int c = 0; c < 3; ++c) {
        double* motion = motions_.data() + kMotions * (3 * i + c);
        motion[c] = moving(c, i);
        for (int k = 0; k < 3; ++k) motion[3 + k] = moving(c, i) * turned(c, k);
      }
    }
  }
  const double* data() const { return motions_.data(); }
  /// Motions of a group about its own centre.
  Mat6 ofGroup(const Vec3& middle, double radius) const {
    Mat6 own = Mat6::Zero();
    own.topLeftCorner<3, 3>().setIdentity();
    if (!(radius > 0.0)) return own;
    own.topRightCorner<3, 3>() = turns((middle_ - middle) / radius);
    own.bottomRightCorner<3, 3>().diagonal().setConstant(unit_ / radius);
    return own;
  }

 private:
  Vec3 middle_;
  double unit_;
  AlignedVector<double> motions_;
};

}  // namespace

Eigen::MatrixXd coarseMatrix(const fem::Stiffness& A, const CoarseGroups& groups,
                             const Points& points, const Points& moving,
                             const PcgKernels& kernels) {
  const CommonMotions motions(points, moving);
  const int count = groups.count();
  AlignedVector<double> sums(static_cast<std::size_t>(3 * kMotions) * count);
  std::vector<int> reached(static_cast<std::size_t>(count));
  const PcgMotions P{groups.group.data(), groups.weight.data(), motions.data(), count,
                     sums.data(),         reached.data()};
  AlignedVector<double> product(static_cast<std::size_t>(6 * kMotions) * count * count, 0.0);
  const fem::BlockMatrix& K = A.blocks();
  for (int i = 0; i < K.numNodes(); ++i) {
    kernels.addBlocks(P, i, K.rowEnd(i) - K.rowBegin(i), K.columns() + K.rowBegin(i),
                      K.values() + 9 * static_cast<std::ptrdiff_t>(K.rowBegin(i)), product.data());
  }
  if (A.hasVolume()) {
    const fem::VolumeStiffness& volume = A.volume();
    const fem::VolumeStiffness::Pattern& pattern = *volume.pattern;
    for (Eigen::Index p = 0; p < volume.numRows(); ++p) {
      const int begin = pattern.start[p];
      kernels.addSquare(P, pattern.start[p + 1] - begin, pattern.node.data() + begin,
                        volume.rows.col(begin).data(), volume.factor * volume.metric->weights()[p],
                        product.data());
    }
  }
  using Block = Eigen::Matrix<double, kMotions, 6>;  // transposed, since it is stored by rows
  std::vector<Mat6> own;
  own.reserve(static_cast<std::size_t>(count));
  for (int g = 0; g < count; ++g)
    own.push_back(motions.ofGroup(groups.middle.col(g), groups.radius[g]));
  Eigen::MatrixXd C(6 * count, 6 * count);
  for (int a = 0; a < count; ++a) {
    for (int b = a; b < count; ++b) {
      const Eigen::Map<const Block> block(product.data() + 6 * kMotions * (count * a + b));
      C.block<6, 6>(6 * a, 6 * b) = own[a].transpose() * block.topRows<6>().transpose() * own[b];
      if (b > a) C.block<6, 6>(6 * b, 6 * a) = C.block<6, 6>(6 * a, 6 * b).transpose();
    }
  }
  return C;
}

}  // namespace palpate::solver

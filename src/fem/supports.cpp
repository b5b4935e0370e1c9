// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/supports.h"

#include <Eigen/Eigenvalues>

namespace palpate::fem {

std::string freeRigidMotions(const Points& X, const FreeMask& free,
                             const std::vector<HeldDirection>& held) {
  using Vec6 = Eigen::Matrix<double, 6, 1>;
  constexpr const char* kNames[6] = {"translation along x", "translation along y",
                                     "translation along z", "rotation about x",
                                     "rotation about y",    "rotation about z"};
  const Vec3 center = X.rowwise().mean();
  const double size = std::max((X.rowwise().maxCoeff() - X.rowwise().minCoeff()).norm(), 1e-300);
  Eigen::Matrix<double, 6, 6> gram = Eigen::Matrix<double, 6, 6>::Zero();
  const auto hold = [&](Eigen::Index i, const Vec3& direction) {
    const Vec3 r = (X.col(i) - center) / size;
    Vec6 motion;
    motion << direction, r.cross(direction);  // direction . (t + w x r)
    gram += motion * motion.transpose();
  };
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    for (int c = 0; c < 3; ++c) {
      if (free(c, i) == 0.0) hold(i, Vec3::Unit(c));
    }
  }
  for (const HeldDirection& h : held) hold(h.node, h.direction);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(gram);
  const double smallest = 1e-10 * std::max(eigen.eigenvalues().maxCoeff(), 1e-300);
  std::string motions;
  for (int k = 0; k < 6; ++k) {
    if (eigen.eigenvalues()[k] > smallest) continue;
    Eigen::Index largest;
    eigen.eigenvectors().col(k).cwiseAbs().maxCoeff(&largest);
    const std::string name = kNames[largest];
    if (motions.find(name) == std::string::npos) motions += (motions.empty() ? "" : ", ") + name;
  }
  return motions;
}

}  // namespace palpate::fem

// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/enrichment/kernel_map.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

namespace palpate::enrichment {
namespace {

// Columns of samples in the order of a pivoted Cholesky factorisation; ties go to the smaller
// index.
std::vector<Eigen::Index> pivots(const Eigen::MatrixXd& K, Eigen::Index most) {
  const Eigen::Index n = K.cols();
  Eigen::VectorXd left = K.diagonal();
  const double least = 1e-12 * left.maxCoeff();
  Eigen::MatrixXd L(n, most);
  std::vector<Eigen::Index> chosen;
  for (Eigen::Index m = 0; m < most; ++m) {
    Eigen::Index at = 0;
    const double pivot = left.maxCoeff(&at);
    if (!(pivot > least)) break;
    L.col(m) = (K.col(at) - L.leftCols(m) * L.row(at).head(m).transpose()) / std::sqrt(pivot);
    left -= L.col(m).cwiseAbs2();
    left[at] = 0.0;
    chosen.push_back(at);
  }
  return chosen;
}

Eigen::MatrixXd kernels(const ResponseSamples& samples) {
  const Eigen::Index n = samples.size();
  Eigen::MatrixXd K(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = 0; i <= j; ++i) {
      K(i, j) = K(j, i) = responseKernel(samples.inputs.col(i), samples.displacements.col(i),
                                         samples.inputs.col(j), samples.displacements.col(j));
    }
  }
  return K;
}

}  // namespace

double responseKernel(const Vec6& x, const Vec3& d, const Vec6& other_x, const Vec3& other_d) {
  return std::exp(-0.5 * (x - other_x).squaredNorm()) * d.dot(other_d);
}

KernelMap::KernelMap(const Eigen::Matrix<double, 6, Eigen::Dynamic>& inputs,
                     const Points& displacements, const Eigen::MatrixXd& weights)
    : inputs_(inputs), displacements_(displacements), weights_(weights) {
  if (inputs.cols() == 0 || displacements.cols() != inputs.cols() ||
      weights.cols() != inputs.cols()) {
    throw std::invalid_argument("a kernel map needs centres, each with a displacement and weights");
  }
}

KernelMap KernelMap::fit(const ResponseSamples& samples, Eigen::Index centres, double ridge) {
  const Eigen::MatrixXd K = kernels(samples);
  const std::vector<Eigen::Index> chosen =
      pivots(K, std::clamp<Eigen::Index>(centres, 1, samples.size()));
  const auto m = static_cast<Eigen::Index>(chosen.size());
  Eigen::MatrixXd some(m, samples.size()), square(m, m);
  Eigen::Matrix<double, 6, Eigen::Dynamic> inputs(6, m);
  Points displacements(3, m);
  for (Eigen::Index a = 0; a < m; ++a) {
    const Eigen::Index at = chosen[static_cast<std::size_t>(a)];
    some.row(a) = K.row(at);
    inputs.col(a) = samples.inputs.col(at);
    displacements.col(a) = samples.displacements.col(at);
    for (Eigen::Index b = 0; b < m; ++b) square(a, b) = K(at, chosen[static_cast<std::size_t>(b)]);
  }
  const Eigen::MatrixXd normal = some * some.transpose() + ridge * square;
  const Eigen::MatrixXd weights =
      normal.ldlt().solve(some * samples.values.transpose()).transpose();
  return KernelMap(inputs, displacements, weights);
}

void KernelMap::evaluate(const Vec6& x, const Vec3& d, Eigen::Index rows,
                         Eigen::VectorXd* y) const {
  y->setZero(rows);
  for (Eigen::Index m = 0; m < inputs_.cols(); ++m) {
    *y += responseKernel(x, d, inputs_.col(m), displacements_.col(m)) * weights_.col(m).head(rows);
  }
}

double leaveGroupsOutError(const ResponseSamples& samples, double ridge,
                           const std::vector<int>& groups) {
  Eigen::MatrixXd system = kernels(samples);
  system.diagonal().array() += ridge;
  const Eigen::LLT<Eigen::MatrixXd> factor(system);
  const Eigen::MatrixXd inverse =
      factor.solve(Eigen::MatrixXd::Identity(samples.size(), samples.size()));
  const Eigen::MatrixXd weights = samples.values * inverse;
  std::map<int, std::vector<Eigen::Index>> members;
  for (Eigen::Index k = 0; k < samples.size(); ++k) {
    members[groups[static_cast<std::size_t>(k)]].push_back(k);
  }
  double sum = 0.0;
  for (const auto& [number, of] : members) {
    const auto n = static_cast<Eigen::Index>(of.size());
    Eigen::MatrixXd block(n, n), some(weights.rows(), n);
    for (Eigen::Index a = 0; a < n; ++a) {
      some.col(a) = weights.col(of[static_cast<std::size_t>(a)]);
      for (Eigen::Index b = 0; b < n; ++b) {
        block(a, b) = inverse(of[static_cast<std::size_t>(a)], of[static_cast<std::size_t>(b)]);
      }
    }
    sum += block.ldlt().solve(some.transpose()).squaredNorm();
  }
  return sum;
}

}  // namespace palpate::enrichment

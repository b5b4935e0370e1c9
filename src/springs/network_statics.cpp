// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/network_statics.h"

#include <Eigen/CholmodSupport>
#include <cmath>
#include <vector>

namespace palpate::springs {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Factor = Eigen::CholmodSupernodalLLT<Matrix>;

/// Indices of the free components.
class FreeParts {
 public:
  explicit FreeParts(const Points& free) : number_(static_cast<std::size_t>(free.size()), -1) {
    for (Eigen::Index i = 0; i < free.size(); ++i) {
      if (free.data()[i] != 0.0) number_[static_cast<std::size_t>(i)] = size_++;
    }
  }
  int size() const { return size_; }

  Eigen::VectorXd pick(const Points& values) const {
    Eigen::VectorXd picked(size_);
    for (std::size_t i = 0; i < number_.size(); ++i) {
      if (number_[i] >= 0) picked[number_[i]] = values.data()[i];
    }
    return picked;
  }
  void put(const Eigen::VectorXd& picked, Points* values) const {
    for (std::size_t i = 0; i < number_.size(); ++i) {
      if (number_[i] >= 0) values->data()[i] = picked[number_[i]];
    }
  }
  Matrix pick(const Matrix& K) const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(K.nonZeros()));
    for (int column = 0; column < K.outerSize(); ++column) {
      const int c = number_[static_cast<std::size_t>(column)];
      for (Matrix::InnerIterator entry(K, column); c >= 0 && entry; ++entry) {
        const int r = number_[static_cast<std::size_t>(entry.row())];
        if (r >= 0) entries.emplace_back(r, c, entry.value());
      }
    }
    Matrix picked(size_, size_);
    picked.setFromTriplets(entries.begin(), entries.end());
    return picked;
  }

 private:
  std::vector<int> number_;
  int size_ = 0;
};

// Error of the energy due to rounding of distances [J].
double energyNoise(const SpringNetwork& network, const Points& x) {
  double sum = 0.0;
  for (const Spring& s : network.springs) {
    const double u = (x.col(s.b) - x.col(s.a)).norm();
    sum += std::abs(springForce(s, u)) * u;
  }
  return 1e-15 * sum;
}

double energyUnderLoads(const SpringNetwork& network, const NetworkLoads& loads, const Points& x) {
  return networkEnergy(network, x) - loads.forces.cwiseProduct(x - network.points).sum();
}

// Factorises K plus the least shift (0 or 10^k times its largest diagonal) that makes it definite.
bool factorizeShifted(Matrix K, Factor* factor) {
  const double largest = K.diagonal().cwiseAbs().maxCoeff();
  Matrix identity(K.rows(), K.cols());
  identity.setIdentity();
  double shift = 0.0;
  for (int trial = 0; trial < 14; ++trial) {
    factor->compute(K + shift * identity);
    if (factor->info() == Eigen::Success) return true;
    shift = shift == 0.0 ? 1e-10 * largest : 10.0 * shift;
  }
  return false;
}

}  // namespace

NetworkLoads noLoads(const SpringNetwork& network) {
  const Eigen::Index n = network.points.cols();
  return {Points::Zero(3, n), Points::Ones(3, n)};
}

Matrix networkTangent(const SpringNetwork& network, const Points& x) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(36 * network.springs.size());
  for (const Spring& s : network.springs) {
    const Mat3 K = springTangent(s, x.col(s.b) - x.col(s.a));
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        entries.emplace_back(3 * s.a + r, 3 * s.a + c, K(r, c));
        entries.emplace_back(3 * s.b + r, 3 * s.b + c, K(r, c));
        entries.emplace_back(3 * s.a + r, 3 * s.b + c, -K(r, c));
        entries.emplace_back(3 * s.b + r, 3 * s.a + c, -K(r, c));
      }
    }
  }
  Matrix tangent(x.size(), x.size());
  tangent.setFromTriplets(entries.begin(), entries.end());
  return tangent;
}

std::optional<Points> linearDisplacements(const SpringNetwork& network, const Points& x,
                                          const NetworkLoads& loads, const Points& prescribed) {
  const FreeParts parts(loads.free);
  const Matrix K = networkTangent(network, x);
  Points moved = prescribed.cwiseProduct(Points::Ones(3, x.cols()) - loads.free);
  if (parts.size() == 0) return moved;
  const Eigen::VectorXd reaction =
      K * Eigen::Map<const Eigen::VectorXd>(moved.data(), moved.size());
  const Points right = loads.forces - Eigen::Map<const Points>(reaction.data(), 3, x.cols());
  Factor factor;
  factor.cholmod().print = 0;
  factor.compute(parts.pick(K));
  if (factor.info() != Eigen::Success) return std::nullopt;
  const Eigen::VectorXd solution = factor.solve(parts.pick(right));
  if (!solution.allFinite()) return std::nullopt;
  parts.put(solution, &moved);
  return moved;
}

NetworkStaticsReport solveNetwork(const SpringNetwork& network, const NetworkLoads& loads,
                                  const NetworkStaticsSettings& settings, Points* x) {
  using solver::SolveStatus;
  const FreeParts parts(loads.free);
  Factor factor;
  factor.cholmod().print = 0;
  double energy = energyUnderLoads(network, loads, *x);
  for (int iteration = 0;; ++iteration) {
    const Eigen::VectorXd pull = parts.pick(Points(networkForces(network, *x) + loads.forces));
    const double imbalance = parts.size() == 0 ? 0.0 : pull.cwiseAbs().maxCoeff();
    if (!std::isfinite(imbalance)) return {SolveStatus::kNonFinite, iteration, imbalance};
    if (imbalance <= settings.largest_imbalance) {
      return {SolveStatus::kConverged, iteration, imbalance};
    }
    if (iteration == settings.iteration_limit) {
      return {SolveStatus::kIterationLimit, iteration, imbalance};
    }
    if (!factorizeShifted(parts.pick(networkTangent(network, *x)), &factor)) {
      return {SolveStatus::kNotPositiveDefinite, iteration, imbalance};
    }
    const Eigen::VectorXd step = factor.solve(pull);
    const double slope = -step.dot(pull);
    const Eigen::VectorXd start = parts.pick(*x);
    const double noise = energyNoise(network, *x);
    bool moved = false;
    for (double alpha = 1.0; alpha > 1e-9 && !moved; alpha *= 0.5) {
      Points trial = *x;
      parts.put(start + alpha * step, &trial);
      const double next = energyUnderLoads(network, loads, trial);
      const bool in_the_noise = std::abs(alpha * slope) <= noise;
      const double left =
          in_the_noise ? parts.pick(Points(networkForces(network, trial) + loads.forces)).norm()
                       : 0.0;
      if (in_the_noise ? left < pull.norm() : next <= energy + 1e-4 * alpha * slope) {
        *x = trial;
        energy = next;
        moved = true;
      }
    }
    if (!moved) return {SolveStatus::kLineSearchFailed, iteration, imbalance};
  }
}

}  // namespace palpate::springs

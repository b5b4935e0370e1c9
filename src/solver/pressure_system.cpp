// SPDX-License-Identifier: GPL-3.0-or-later
#include "pressure_system.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "cholmod_factor.h"

namespace palpate::solver {
namespace {

constexpr int kMostIterations = 400;
// Safety factor of the residual for a metric known only by its diagonal; 1/6 was measured at worst.
constexpr double kKnownByDiagonal = 0.1;
// Iterations over the square root of `worst` below. Measured for `anp` on a pressed cube: 16
// iterations to 1e-3 at nu = 0.45 (root 1.7), and 92 at 0.499 (root 10.3).
constexpr double kIterations = 9.0;

// Computes c = W^-1 p.
void divideByMetric(const fem::VolumeStiffness& volume, const Eigen::VectorXd& p,
                    Eigen::VectorXd* c) {
  if (volume.metric->isDiagonal()) {
    *c = p.cwiseQuotient(volume.factor * volume.metric->weights());
  } else {
    *c = volume.metric->compliance() * p / volume.factor;
  }
}

}  // namespace

PressureSystem::PressureSystem() : factor_(std::make_unique<CholmodFactor>(Volumes::kLeftOut)) {}
PressureSystem::~PressureSystem() = default;

SolveStatus PressureSystem::factorize(const fem::Stiffness& K) { return factor_->factorize(K); }

double PressureSystem::prepare(const fem::Stiffness& K) {
  const fem::VolumeStiffness& volume = K.volume();
  const fem::VolumeStiffness::Pattern& pattern = *volume.pattern;
  diagonal_.resize(static_cast<std::size_t>(K.numNodes()));
  for (int i = 0; i < K.numNodes(); ++i) {
    diagonal_[i] = Mat3(K.blocks().block(K.blocks().diagonal(i))).inverse();
  }
  preconditioner_.resize(volume.numRows());
  double worst = 1.0;  // largest ratio of stiffness against a volume change, with and without W
  for (Eigen::Index p = 0; p < volume.numRows(); ++p) {
    const double weight = volume.factor * volume.metric->weights()[p];
    double sum = 1.0 / weight;
    for (int k = pattern.start[p]; k < pattern.start[p + 1]; ++k) {
      sum += volume.rows.col(k).dot(diagonal_[pattern.node[k]] * volume.rows.col(k));
    }
    preconditioner_[p] = 1.0 / sum;
    worst = std::max(worst, weight * sum);
  }
  return kIterations * std::sqrt(worst);
}

const CholmodFactor& PressureSystem::analyze(const fem::Stiffness& K) {
  factor_->analyze(K);
  return *factor_;
}

// |b - K x| for the residual r of the pressures: the norm of B^T W r, with W's diagonal.
double PressureSystem::residual(const fem::VolumeStiffness& volume, const Eigen::VectorXd& r) {
  c_ = volume.factor * volume.metric->weights().cwiseProduct(r);
  f_.setZero();
  volume.addTransposed(c_, &f_);
  return f_.norm();
}

LinearReport PressureSystem::solve(const fem::Stiffness& K, const Points& b,
                                   double relative_tolerance, Points* x) {
  const fem::VolumeStiffness& volume = K.volume();
  LinearReport report;
  if (factor_->solve(b, x) != SolveStatus::kConverged) return {SolveStatus::kNonFinite, 0};
  f_.resize(3, b.cols());
  volume.multiplyRows(*x, &r_);
  const double exact = volume.metric->isDiagonal() ? 1.0 : kKnownByDiagonal;
  const double target = exact * relative_tolerance * b.norm();
  double rz = 0.0;
  while (residual(volume, r_) > target) {
    if (report.iterations == kMostIterations) {
      report.status = SolveStatus::kIterationLimit;
      break;
    }
    z_ = preconditioner_.cwiseProduct(r_);
    const double rz_last = rz;
    rz = r_.dot(z_);
    if (report.iterations == 0) {
      d_ = z_;
    } else {
      d_ = z_ + (rz / rz_last) * d_;
    }
    f_.setZero();
    volume.addTransposed(d_, &f_);
    if (factor_->solve(f_, &t_) != SolveStatus::kConverged) {
      return {SolveStatus::kNonFinite, report.iterations};
    }
    volume.multiplyRows(t_, &Sd_);
    divideByMetric(volume, d_, &c_);
    Sd_ += c_;
    const double alpha = rz / d_.dot(Sd_);
    if (!std::isfinite(alpha)) return {SolveStatus::kNonFinite, report.iterations};
    *x -= alpha * t_;
    r_ -= alpha * Sd_;
    ++report.iterations;
  }
  return report;
}

}  // namespace palpate::solver

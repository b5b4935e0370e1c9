// SPDX-License-Identifier: GPL-3.0-or-later
#include "critical_step.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::tissue {
namespace {

constexpr int kRestSteps = 40;
constexpr int kFollowSteps = 4;
constexpr double kNoise = 0.5;
// Displacement that requires an update, and difference step, over the element size [-].
constexpr double kNoticeable = 0.02;
constexpr double kShift = 1e-6;
// Strains that make tension-only fibres taut, along an axis or across it. A relative change of
// stiffness above the threshold indicates such fibres.
constexpr double kTaut = 1e-6, kTautPart = 1e-3;
// Factor on w^2 of such fibres. Two steps h of an oscillator of stiffness a / h^2, then b / h^2,
// have a matrix of trace (2 - a) (2 - b) - 2 and determinant 1: a mode taut in every second step
// grows for a > 2 > b. None does for a <= 2, half of the bound without a change.
constexpr double kTwoSided = 4.0 / 2.0 * CriticalStep::kSafety * CriticalStep::kSafety * 1.02;
// Step without relaxation [s], at which viscous bodies are stiffest.
constexpr double kSudden = 1e-6;

// Deterministic noise with entries of modulus in [0.5, 1.5], not small in any mode.
double noise(Eigen::Index k) {
  const double value = 0.5 + std::fmod(0.754877666 * (static_cast<double>(k) + 1.0), 1.0);
  return std::fmod(0.569840290 * (static_cast<double>(k) + 1.0), 1.0) < 0.5 ? value : -value;
}

}  // namespace

CriticalStep::CriticalStep(fem::Elasticity* elasticity, const fem::FreeMask& free,
                           double other_squares)
    : elasticity_(*elasticity),
      scale_(free * elasticity->masses().cwiseSqrt().cwiseInverse().asDiagonal()),
      element_size_(std::cbrt(elasticity->volume() / static_cast<double>(free.cols()))),
      other_squares_(other_squares) {}

// Upper bound of the largest eigenvalue of the symmetric operator `multiply`; mode_ is the start
// and becomes the eigenvector.
template <class Multiply>
double CriticalStep::lanczos(int steps, const Multiply& multiply) {
  using Few = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kRestSteps, 1>;  // no allocation
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kRestSteps, kRestSteps>;
  Few alpha(steps), beta(steps);
  int size = 0;
  double residual = 0.0;
  while (size < steps) {
    basis_[size] = mode_;
    multiply(mode_, &next_);
    alpha[size] = next_.cwiseProduct(mode_).sum();
    next_ -= alpha[size] * mode_;
    if (size > 0) next_ -= beta[size - 1] * basis_[size - 1];
    residual = next_.norm();
    beta[size++] = residual;
    if (!(residual > 1e-10 * std::abs(alpha[0]))) break;  // spectrum exhausted, or NaN
    mode_ = next_ / residual;
  }
  Eigen::SelfAdjointEigenSolver<Square> ritz;
  ritz.computeFromTridiagonal(alpha.head(size), beta.head(size - 1));
  const Few weights = ritz.eigenvectors().col(size - 1);
  mode_.setZero();
  for (int k = 0; k < size; ++k) mode_ += weights[k] * basis_[k];
  mode_.normalize();
  return ritz.eigenvalues()[size - 1] + residual * std::abs(weights[size - 1]);
}

void CriticalStep::begin(const Points& X) {
  rest_ = looked_at_ = X;
  if (scale_.isZero()) return;
  basis_.resize(kRestSteps);
  fem::Stiffness K = elasticity_.makeMatrix();
  const auto multiply = [&](const Points& q, Points* Aq) {
    shifted_ = scale_.cwiseProduct(q);
    K.multiply(shifted_, Aq);
    Aq->array() *= scale_.array();
  };
  elasticity_.beginStep(kSudden);
  elasticity_.hessian(X, fem::Tangent::kExact, &K);
  Points at_rest;
  multiply(noiseMode(), &at_rest);
  mode_ = noiseMode();
  rest_square_ = lanczos(kRestSteps, multiply);
  rest_mode_ = mode_;
  // Fibres that are slack at rest become taut in motion.
  for (const double strain : {kTaut, -kTaut}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 stretch = Vec3::Constant(1.0 - 0.5 * strain);
      stretch[axis] = 1.0 + strain;
      elasticity_.hessian(stretch.asDiagonal() * X, fem::Tangent::kExact, &K);
      multiply(noiseMode(), &gradient_);
      if ((gradient_ - at_rest).norm() <= kTautPart * at_rest.norm()) continue;
      mode_ = noiseMode();
      const double square = kTwoSided * lanczos(kRestSteps, multiply);
      least_square_ = std::max(least_square_, square);
      if (!(square > rest_square_)) continue;
      rest_square_ = square;
      rest_mode_ = mode_;
    }
  }
  elasticity_.beginStep(std::numeric_limits<double>::infinity());
  square_ = rest_square_;
  mode_ = rest_mode_;
  basis_.resize(kFollowSteps);
}

// Scaled noise on free components.
Points CriticalStep::noiseMode() const {
  Points mode = scale_;
  for (Eigen::Index k = 0; k < mode.size(); ++k) {
    if (mode.data()[k] != 0.0) mode.data()[k] = noise(k);
  }
  return mode / mode.norm();
}

// Adds noise to mode_ in proportion to the displacement since the last update.
void CriticalStep::seed(const Points& x) {
  next_ = (x - looked_at_).cwiseProduct(scale_);
  for (Eigen::Index k = 0; k < next_.size(); ++k) next_.data()[k] *= noise(k);
  const double norm = next_.norm();
  if (norm > 0.0) mode_ += kNoise / norm * next_;
  mode_.normalize();
}

void CriticalStep::follow(const Points& x) {
  if (!(rest_square_ > 0.0)) return;
  const double noticeable = kNoticeable * element_size_;
  if ((x - looked_at_).cwiseAbs().maxCoeff() <= noticeable) return;
  if ((x - rest_).cwiseAbs().maxCoeff() <= noticeable) {
    square_ = rest_square_;
    mode_ = rest_mode_;
    looked_at_ = x;
    return;
  }
  seed(x);
  looked_at_ = x;
  elasticity_.beginStep(kSudden);
  elasticity_.gradient(x, &gradient_);
  square_ = lanczos(kFollowSteps, [&](const Points& q, Points* Aq) {
    shifted_ = scale_.cwiseProduct(q);
    const double shift = kShift * element_size_ / shifted_.cwiseAbs().maxCoeff();
    shifted_ = x + shift * shifted_;
    elasticity_.gradient(shifted_, Aq);
    *Aq = (*Aq - gradient_).cwiseProduct(scale_) / shift;
  });
  if (square_ < least_square_) square_ = least_square_;
  // NaN or a vanishing stiffness: restart from the mode at rest.
  if (!(square_ > 0.1 * rest_square_) || !std::isfinite(square_)) {
    mode_ = rest_mode_;
    square_ = rest_square_;
  }
}

void CriticalStep::save(StateWriter* out) const {
  out->put(square_);
  out->put(mode_);
  out->put(looked_at_);
}

void CriticalStep::restore(StateReader* in) {
  in->get(&square_);
  in->getSame(&mode_);
  in->getSame(&looked_at_);
}

double CriticalStep::seconds() const {
  const double square = square_ + other_squares_;
  return square > 0.0 ? 2.0 / std::sqrt(square) : std::numeric_limits<double>::infinity();
}

double CriticalStep::squeezed() const {
  return rest_square_ > 0.0
             ? std::sqrt((square_ + other_squares_) / (rest_square_ + other_squares_))
             : 1.0;
}

}  // namespace palpate::tissue

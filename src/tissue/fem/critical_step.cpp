// SPDX-License-Identifier: GPL-3.0-or-later
#include "critical_step.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace palpate::tissue {
namespace {

constexpr int kRestSteps = 40;
constexpr int kFollowSteps = 4;
constexpr double kNoise = 0.5;
// Motion since the last look, and the shift of a difference, in parts of an element.
constexpr double kNoticeable = 0.02;
constexpr double kShift = 1e-6;
// [s] So short that nothing relaxes: viscous bodies are stiffest then.
constexpr double kSudden = 1e-6;

// Not small in any mode, between 0.5 and 1.5 of either sign, and always the same.
double noise(Eigen::Index k) {
  const double value = 0.5 + std::fmod(0.754877666 * (static_cast<double>(k) + 1.0), 1.0);
  return std::fmod(0.569840290 * (static_cast<double>(k) + 1.0), 1.0) < 0.5 ? value : -value;
}

}  // namespace

CriticalStep::CriticalStep(fem::Elasticity* elasticity, const fem::FreeMask& free, double beside)
    : elasticity_(*elasticity),
      scale_(free * elasticity->masses().cwiseSqrt().cwiseInverse().asDiagonal()),
      element_size_(std::cbrt(elasticity->volume() / static_cast<double>(free.cols()))),
      beside_(beside) {}

// Bound of the largest eigenvalue of the symmetric matrix that `multiply` applies, from mode_ on,
// which ends as its eigenvector.
template <class Multiply>
double CriticalStep::lanczos(int steps, const Multiply& multiply) {
  using Few = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kRestSteps, 1>;  // not on the heap
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
    if (!(residual > 1e-10 * std::abs(alpha[0]))) break;  // all of the spectrum is seen, or NaN
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
  mode_ = scale_;
  for (Eigen::Index k = 0; k < mode_.size(); ++k) {
    if (mode_.data()[k] != 0.0) mode_.data()[k] = noise(k);
  }
  mode_.normalize();
  fem::Stiffness K = elasticity_.makeMatrix();
  elasticity_.beginStep(kSudden);
  elasticity_.hessian(X, fem::Tangent::kExact, &K);
  elasticity_.beginStep(std::numeric_limits<double>::infinity());
  rest_square_ = square_ = lanczos(kRestSteps, [&](const Points& q, Points* Aq) {
    shifted_ = scale_.cwiseProduct(q);
    K.multiply(shifted_, Aq);
    Aq->array() *= scale_.array();
  });
  rest_mode_ = mode_;
  basis_.resize(kFollowSteps);
}

// Adds to mode_ noise in proportion to the motion since the last look.
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
  // Not a number, or all went soft: begin anew with what is known of the rest.
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
  const double square = square_ + beside_;
  return square > 0.0 ? 2.0 / std::sqrt(square) : std::numeric_limits<double>::infinity();
}

double CriticalStep::squeezed() const {
  return rest_square_ > 0.0 ? std::sqrt((square_ + beside_) / (rest_square_ + beside_)) : 1.0;
}

}  // namespace palpate::tissue

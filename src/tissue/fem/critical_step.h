// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/fem/elasticity.h"
#include "palpate/fem/supports.h"

namespace palpate::tissue {

/// The longest stable step of central differences, 2 / w, where w^2 is the largest eigenvalue of
/// M^-1 K over the free components [Belytschko, Liu, Moran 2000, sec. 6.2].
///
/// w^2 is bounded by Lanczos' iteration with its residual [Zhou, Li 2011]: at rest on the assembled
/// stiffness; later in a few steps on differences of elastic gradients, so that no matrix is
/// assembled, from the last eigenvector and a bit of noise where the body has moved since: modes of
/// elements that have just been squeezed are found there. Fibres that resist tension only, slack at
/// rest, count as taut, and the step is so short that changing from one to the other adds nothing.
class CriticalStep {
 public:
  /// Part of it that is taken.
  static constexpr double kSafety = 0.9;

  /// `elasticity` must outlive this. `other_squares` [1/s^2]: bound of the squares of the
  /// frequencies of what acts other_squares it, which adds no more than this to w^2 [Weyl 1912].
  CriticalStep(fem::Elasticity* elasticity, const fem::FreeMask& free, double other_squares = 0.0);

  /// The bound at `X`, 3 x n [m], where the body rests relaxed. Ends with the body relaxed.
  void begin(const Points& X);
  /// Follows the body to x, 3 x n [m], if it has moved noticeably since the last look.
  void follow(const Points& x);

  void save(StateWriter* out) const;
  /// After begin(), of the same body.
  void restore(StateReader* in);

  /// [s]; infinity if nothing is free.
  double seconds() const;
  /// How many times shorter it is than at rest; 1 if nothing is free.
  double squeezed() const;

 private:
  template <class Multiply>
  double lanczos(int steps, const Multiply& multiply);
  void seed(const Points& x);
  Points noiseMode() const;

  fem::Elasticity& elasticity_;
  Points scale_;          // 1/sqrt(m) where free, else 0
  double element_size_;   // [m]
  double other_squares_;  // [1/s^2]
  double square_ = 0.0;   // w^2 of the elasticity [1/s^2]
  double rest_square_ = 0.0;
  double least_square_ = 0.0;  // of fibres that may be taut at any time, else 0
  Points mode_, rest_mode_;    // of w, times sqrt(m): unit
  Points rest_, looked_at_;
  Points gradient_, shifted_, next_;
  std::vector<Points> basis_;
};

}  // namespace palpate::tissue

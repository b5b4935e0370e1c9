// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/fem/elasticity.h"
#include "palpate/fem/supports.h"

namespace palpate::tissue {

/// Critical step of central differences, 2 / w [s], with w^2 the largest eigenvalue of M^-1 K over
/// the free components [Belytschko, Liu, Moran 2000, sec. 6.2].
///
/// Lanczos' iteration with its residual bounds w^2 [Zhou, Li 2011]: at rest on the assembled
/// stiffness, later on differences of elastic gradients without a matrix. It starts from the last
/// eigenvector, with noise at displaced nodes to find modes of compressed elements. Fibres that
/// resist tension only count as taut.
class CriticalStep {
 public:
  /// Factor of safety on the critical step [-].
  static constexpr double kSafety = 0.9;

  /// `other_squares`: upper bound of the squared frequencies of all other forces, added to w^2
  /// [Weyl 1912] [1/s^2].
  /// @pre `elasticity` outlives this.
  CriticalStep(fem::Elasticity* elasticity, const fem::FreeMask& free, double other_squares = 0.0);

  /// Computes the bound in the relaxed rest configuration `X`, 3 x n [m], and leaves the body
  /// relaxed.
  void begin(const Points& X);
  /// Updates the bound at x, 3 x n [m], where nodes have moved noticeably since the last update.
  void follow(const Points& x);

  void save(StateWriter* out) const;
  /// @pre begin() with the same body.
  void restore(StateReader* in);

  /// Critical step [s]; infinity without free components.
  double seconds() const;
  /// Ratio of the critical step at rest to the present one [-]; 1 without free components.
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
  double square_ = 0.0;   // of the elasticity, w^2 [1/s^2]
  double rest_square_ = 0.0;
  double least_square_ = 0.0;  // of fibres that may be taut at any time, else 0
  Points mode_, rest_mode_;    // of w, times sqrt(m): unit
  Points rest_, looked_at_;
  Points gradient_, shifted_, next_;
  std::vector<Points> basis_;
};

}  // namespace palpate::tissue

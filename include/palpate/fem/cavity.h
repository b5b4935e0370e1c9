// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "palpate/fem/energy_term.h"

namespace palpate::fem {

/// What fills a cavity, and how it presses.
struct CavityContent {
  double pressure = 0.0;          ///< Of its rest [Pa].
  double volume_stiffness = 0.0;  ///< Pressure by relative change of volume, K [Pa].
  /// The walls are at rest under `pressure`: only what differs from it acts.
  bool balanced = false;
};

/// Pressure of a content on faces of a body, normal to them as they are deformed:
///
///   p = p_0 - K (V - V_0)/V_0,   energy K/(2 V_0) (V - V_0)^2 - p_0 (V - V_0)
///
/// V the volume that closed faces enclose, V_0 what it was when the content was sealed in; until
/// then p = p_0. The derivative of V by node a is minus the integral of N_a dx/dr x dx/ds over its
/// faces, which are outward from the body, into the cavity [Bonet, Wood 2008, sec. 8.5.2]. The
/// second derivative is that of -p V, which reaches no further than a face, and
/// K/V_0 dV/dx (dV/dx)^T, a Stiffness::addRankOne().
class CavityPressure final : public EnergyTerm {
 public:
  /// `faces`: 3 x k or 6 x k, at rest in X.
  /// @throws std::invalid_argument for a volume stiffness where the faces enclose no volume.
  CavityPressure(const Points& X, Eigen::MatrixXi faces, const CavityContent& content);

  /// Its pressure of rest times `factor`.
  void setFactor(double factor) { factor_ = factor; }
  /// From here on the content is that which fills the cavity at x, 3 x n.
  void seal(const Points& x) { sealed_volume_ = volume(x); }
  /// V_0, once it is sealed [m^3].
  const std::optional<double>& sealedVolume() const { return sealed_volume_; }
  void setSealedVolume(const std::optional<double>& volume) { sealed_volume_ = volume; }

  /// V [m^3]; of open faces what is under them, to the negative side.
  double volume(const Points& x) const;
  /// p [Pa].
  double pressure(const Points& x) const { return pressureAt(volume(x)); }
  /// Whether it does anything to a body that is at rest.
  bool actsAtRest() const { return !content_.balanced && content_.pressure != 0.0; }
  bool isClosed() const { return closed_; }
  bool resistsVolume() const { return content_.volume_stiffness > 0.0; }

  double value(const Points& x) const override;
  double addGradient(const Points& x, Points* g) const override;
  void addHessian(const Points& x, Tangent tangent, Stiffness* K) const override;
  bool conservative() const override { return closed_; }

  /// Bound of the square of the frequencies of its stiffness at X alone on these masses, n [1/s^2].
  double largestSquare(const Points& X, const Eigen::VectorXd& masses) const;

 private:
  double pressureAt(double volume) const;
  /// What acts of it.
  double excess(double volume) const;

  Eigen::MatrixXi faces_;
  CavityContent content_;
  bool closed_;
  double factor_ = 1.0;
  std::optional<double> sealed_volume_;
  std::vector<int> nodes_, place_;  // of the faces; of each node of the body among them, or -1
  mutable Points slope_;            // dV/dx of nodes_ [m^2]
};

}  // namespace palpate::fem

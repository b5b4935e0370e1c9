// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "palpate/fem/energy_term.h"

namespace palpate::fem {

/// Pressure law of a cavity's content.
struct CavityContent {
  double pressure = 0.0;          ///< Pressure at rest [Pa].
  double volume_stiffness = 0.0;  ///< K, pressure per relative volume change [Pa].
  /// Whether the walls are at rest under `pressure`; only the difference then acts.
  bool balanced = false;
};

/// Pressure of a cavity's content on the faces of a body, normal to the deformed faces:
///
///   p = p_0 - K (V - V_0)/V_0,   energy K/(2 V_0) (V - V_0)^2 - p_0 (V - V_0)
///
/// V is the volume enclosed by closed faces, V_0 its value at seal(); before seal(), p = p_0.
/// dV/dx_a is minus the integral of N_a dx/dr x dx/ds over the faces, which point out of the body
/// [Bonet, Wood 2008, sec. 8.5.2]. The stiffness is that of -p V, within each face, and the
/// rank-one update K/V_0 dV/dx (dV/dx)^T.
class CavityPressure final : public EnergyTerm {
 public:
  /// `faces`: 3 x k or 6 x k, at rest in X.
  /// @throws std::invalid_argument for a volume stiffness where the faces enclose no volume.
  CavityPressure(const Points& X, Eigen::MatrixXi faces, const CavityContent& content);

  /// Multiplies the pressure at rest by `factor`.
  void setFactor(double factor) { factor_ = factor; }
  /// Sets V_0 to the volume at x, 3 x n.
  void seal(const Points& x) { sealed_volume_ = volume(x); }
  /// V_0 [m^3]; empty before seal().
  const std::optional<double>& sealedVolume() const { return sealed_volume_; }
  void setSealedVolume(const std::optional<double>& volume) { sealed_volume_ = volume; }

  /// V [m^3]; of open faces the volume below them, negative.
  double volume(const Points& x) const;
  /// p [Pa].
  double pressure(const Points& x) const { return pressureAt(volume(x)); }
  /// Whether the pressure acts on a body at rest.
  bool actsAtRest() const { return !content_.balanced && content_.pressure != 0.0; }
  bool isClosed() const { return closed_; }
  bool resistsVolume() const { return content_.volume_stiffness > 0.0; }

  double value(const Points& x) const override;
  double addGradient(const Points& x, Points* g) const override;
  void addHessian(const Points& x, Tangent tangent, Stiffness* K) const override;
  bool conservative() const override { return closed_; }

  /// Bound of the squared frequencies of its stiffness at X alone, for n nodal masses [1/s^2].
  double largestSquare(const Points& X, const Eigen::VectorXd& masses) const;

 private:
  double pressureAt(double volume) const;
  /// Pressure that acts: without the balanced part [Pa].
  double excess(double volume) const;

  Eigen::MatrixXi faces_;
  CavityContent content_;
  bool closed_;
  double factor_ = 1.0;
  std::optional<double> sealed_volume_;
  std::vector<int> nodes_, place_;  // nodes of the faces; index of each body node in nodes_, or -1
  mutable Points slope_;            // dV/dx of nodes_ [m^2]
};

}  // namespace palpate::fem

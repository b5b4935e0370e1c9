// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/fem/energy_term.h"

namespace palpate::contact {

/// Distances and pressure of contact between layers of a sheet.
struct LayerSettings {
  double least;     ///< T_l: least distance of layers [m], >= 0.
  double most;      ///< T_h: distance beyond which layers do not interact [m].
  double pressure;  ///< p: layers at (T_l + T_h)/2 press with 1.5 p [Pa], > 0.
};

/// Layers of a rolled or folded sheet of triangles against one another, whichever sides they turn
/// to one another: an energy of its points x, 3 x n [m]. Each point i, of the area A_i, feels all
/// triangles that were far from it along the sheet: with y = (g - T_l)/(T_h - T_l) of their
/// distance g,
///
///   W = sum over pairs  A_i p (T_h - T_l) phi(y),   phi(y) = (1 - y)^2 / (2 y) below 1, else 0,
///
/// which has no bound towards T_l; below y = kFloor it goes on as its parabola there. The gradient
/// is exact, so the forces have no sum and no moment. Of Wang's roll in a tube, whose layers keep a
/// gap in [T_l, T_h] [Wang 2005, 6.4.2].
class LayerContact final : public fem::EnergyTerm {
 public:
  static constexpr double kFloor = 0.2;

  /// `X`: points at rest, 3 x n [m]; `areas`: of each [m^2]. Points and triangles nearer at rest
  /// than 2.5 mean edges, or 2 T_h, do not interact.
  /// @throws std::invalid_argument unless 0 <= T_l < T_h and p > 0.
  LayerContact(const Points& X, const Eigen::Matrix3Xi& triangles, const Eigen::VectorXd& areas,
               const LayerSettings& settings);

  double value(const Points& x) const override;
  double addGradient(const Points& x, Points* g) const override;
  void addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const override;
  /// Limits a step to half the distance of any two layers.
  double maxStep(const Points& x, const Points& d) const override;

  /// The least distance of layers at x, or infinity where none are within T_h [m].
  double leastGap(const Points& x) const;
  /// Bound of the squares of frequencies of points with these masses, n [kg], while no point
  /// meets more than eight triangles [1/s^2].
  double largestSquare(const Eigen::VectorXd& masses) const;

 private:
  struct Pair {
    int point, triangle;
  };
  /// Finds the pairs that may be within T_h while no point goes farther than half a margin.
  void search(const Points& x) const;
  void find(const Points& x) const;
  template <class Visit>
  void forNear(const Points& x, double reach, const Visit& visit) const;

  Points X_;
  Eigen::Matrix3Xi triangles_;
  Eigen::VectorXd areas_;
  LayerSettings settings_;
  double apart_;   // at rest: nearer ones do not meet [m]
  double margin_;  // [m]
  mutable Points searched_at_, middles_;
  mutable Eigen::VectorXd sizes_;
  mutable std::vector<Pair> pairs_;
};

}  // namespace palpate::contact

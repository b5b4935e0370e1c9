// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/fem/elastic_energy.h"
#include "spring_arrays.h"

namespace palpate::tissue {

/// Energy of springs between points [Wang 2005, sec. 2.2]:
///
///   W = sum over springs  P (u - u0) + k/2 (u - u0)^2,   u the distance of its ends.
class SpringForces {
 public:
  /// @throws std::invalid_argument as springs::checkNetwork(), and for a network of other points
  /// than `num_points`.
  SpringForces(const springs::SpringNetwork& network, Eigen::Index num_points);

  const SpringArrays& springs() const { return springs_; }
  /// Upper bound of squared frequencies in any configuration: springs::largestStep() [1/s^2].
  double largestSquare() const { return largest_square_; }

  /// As in fem::Elasticity.
  fem::Stiffness makeMatrix() const;
  double energy(const Points& x) const { return springs_.energy(x); }
  double gradient(const Points& x, Points* g) const;
  void hessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const;

 private:
  int num_points_;
  SpringArrays springs_;
  double largest_square_;
};

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/fem/elastic_energy.h"
#include "palpate/fem/stiffness.h"

namespace palpate::fem {

/// An energy of nodal positions x, 3 x n [m], in addition to the elastic energy: a load, inertia,
/// contact.
class EnergyTerm {
 public:
  virtual ~EnergyTerm() = default;

  /// Energy at x [J].
  virtual double value(const Points& x) const = 0;
  /// The energy; g += its gradient [N], which is minus the force on the nodes.
  virtual double addGradient(const Points& x, Points* g) const = 0;
  /// K += the second derivative [N/m], or a positive semidefinite part by `tangent`. Off-diagonal
  /// blocks between any nodes by Stiffness::add() or addPoint().
  virtual void addHessian(const Points& x, Tangent tangent, Stiffness* K) const = 0;
  /// Largest fraction in [0, 1] of the step d from x for which the term is valid; start of line
  /// searches.
  virtual double maxStep(const Points& /*x*/, const Points& /*d*/) const { return 1.0; }
  /// Whether the gradient derives from the value; false for a follower pressure on an open patch.
  virtual bool conservative() const { return true; }
};

}  // namespace palpate::fem

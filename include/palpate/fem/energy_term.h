// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/fem/elastic_energy.h"
#include "palpate/fem/stiffness.h"

namespace palpate::fem {

/// Something beside the elastic energy that acts on nodal positions x, 3 x n [m]: a load, inertia,
/// contact. It adds to what is there.
class EnergyTerm {
 public:
  virtual ~EnergyTerm() = default;

  /// Energy at x [J].
  virtual double value(const Points& x) const = 0;
  /// The energy; g += its gradient [N], which is minus the force on the nodes.
  virtual double addGradient(const Points& x, Points* g) const = 0;
  /// K += its second derivative [N/m], or a positive semidefinite part of it where `tangent` asks:
  /// off the diagonal by Stiffness::add() or addPoint(), between any nodes.
  virtual void addHessian(const Points& x, Tangent tangent, Stiffness* K) const = 0;
  /// Largest part in [0, 1] of the step d from x that this term can be trusted over; a line search
  /// begins there.
  virtual double maxStep(const Points& /*x*/, const Points& /*d*/) const { return 1.0; }
  /// Whether the gradient is that of the value; a follower pressure on an open patch has none.
  virtual bool conservative() const { return true; }
};

}  // namespace palpate::fem

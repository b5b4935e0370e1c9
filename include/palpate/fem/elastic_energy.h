// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/fem/stiffness.h"

namespace palpate::fem {

/// What the tangent of an element is used for.
enum class Tangent {
  kExact,        ///< d2W/dx2 of the elements and of every term.
  kConvexTerms,  ///< Exact in the elements; terms leave out what is not positive semidefinite.
  kProjected,    ///< Elements too: their nearest positive semidefinite matrices.
};

/// Elastic energy of nodes at x, 3 x n [m], with its derivatives: all that solvers need of a body.
/// Not thread-safe: calls share scratch memory.
class ElasticEnergy {
 public:
  virtual ~ElasticEnergy() = default;

  /// A matrix with the body's pattern, all zero.
  virtual Stiffness makeMatrix() const = 0;
  /// W(x) [J]; +infinity for inverted elements (J <= 0) of laws that need J > 0.
  virtual double energy(const Points& x) = 0;
  /// W(x) and its gradient dW/dx, 3 x n [N]: minus the elastic forces. `g` is overwritten.
  virtual double gradient(const Points& x, Points* g) = 0;
  /// d2W/dx2 [N/m] into `K`, which has the body's pattern and is overwritten.
  virtual void hessian(const Points& x, Tangent tangent, Stiffness* K) = 0;
  /// Whether the energy also depends on the deformation history.
  virtual bool viscous() const = 0;
};

}  // namespace palpate::fem

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/solver/minimizer.h"

namespace palpate::solver {

// Common parts of all minimisers.

/// Whether the iteration ends at this value and gradient g; sets report->residual to the norm and
/// report->status to the reason.
bool isOver(double value, const Points& g, const fem::FreeMask& free,
            const NewtonSettings& settings, int max_iterations, NewtonReport* report);

/// System A d = right of Minimizer::predict(), with A the projected tangent and g the gradient at
/// x. Returns false for non-finite values.
bool tangentSystem(const Potential& potential, const Points& x, const Points& move,
                   fem::Stiffness* A, Points* g, Points* right);

/// Moves x by `move` + `d` unless the potential is not finite there. `scratch` is overwritten.
SolveStatus moveIfFinite(const Potential& potential, const Points& move, const Points& d, Points* x,
                         Points* scratch);

/// Norm of the force due to rounding of x with the stiffness A [N].
double roundoffForce(const fem::Stiffness& A, const Points& x);

}  // namespace palpate::solver

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/solver/minimizer.h"

namespace palpate::solver {

// What all methods of minimising do alike.

/// Whether no further iteration is to begin where the potential has this value and the gradient g;
/// report->residual receives its norm, report->status why it ends.
bool isOver(double value, const Points& g, const fem::FreeMask& free,
            const NewtonSettings& settings, int max_iterations, NewtonReport* report);

/// The system A d = right of Minimizer::predict(), A the projected tangent at x, and the gradient g
/// there. False if that is not finite.
bool tangentSystem(const Potential& potential, const Points& x, const Points& move,
                   fem::Stiffness* A, Points* g, Points* right);

/// Moves x by `move` and `d` unless the potential is not finite there. `scratch` is overwritten.
SolveStatus moveIfFinite(const Potential& potential, const Points& move, const Points& d, Points* x,
                         Points* scratch);

/// Norm of the force that rounding alone makes at x with the stiffness A [N].
double roundoffForce(const fem::Stiffness& A, const Points& x);

}  // namespace palpate::solver

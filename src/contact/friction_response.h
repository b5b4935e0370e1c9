// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/contact/response.h"

namespace palpate::contact {

/// Adds dry friction, and holding by teeth, to the response `normal`.
///
/// The stick point is where a touch began. A spring of stiffness k in the slip plane, with stretch
/// d relative to the moving obstacle, has the energy
///
///   k d^2 / 2 up to the force L, then L (d - L / (2 k)): the stick point follows,
///
/// the return mapping of Coulomb's law [Wriggers 2006, Computational contact mechanics], C1 and
/// convex. L = mu N with N extrapolated from the last step. Where friction exceeds mu N of the
/// solution, or a touch begins to slip, an augmentation updates L with under-relaxation, and mu
/// becomes the kinetic coefficient until the spring force is below L. Sticking touches so do not
/// creep, and reported friction is at most mu N. A touch is frictionless in its first step.
///
/// Teeth hold samples that were pressed at a step's end: by the spring without limit, and by a
/// second one for gap > 0. They release a touch above the traction Friction::teeth until it ends,
/// and all touches of an obstacle without total pressure.
std::unique_ptr<Response> withFriction(std::unique_ptr<Response> normal,
                                       const ResponseSettings& settings);

}  // namespace palpate::contact

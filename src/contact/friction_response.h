// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "friction_list.h"
#include "palpate/contact/response.h"

namespace palpate::contact {

/// Adds dry friction by `laws`, and holding, to the response `normal`.
///
/// The stick point is where a touch began. A spring of stiffness k in the slip plane, with stretch
/// d relative to the moving obstacle, has the energy
///
///   k d^2 / 2 up to the force L, then L (d - L / (2 k)): the stick point follows,
///
/// the return mapping of Coulomb's law [Wriggers 2006, Computational contact mechanics], C1 and
/// convex. L(N) is the limit of FrictionLaw::limit(), with N extrapolated from the last step. Where
/// friction exceeds L(N) of the solution, or a touch begins to slip, an augmentation updates L with
/// under-relaxation, and the touch slides until the spring force is below L. Sticking touches so do
/// not creep, and reported friction is at most L(N). A touch is frictionless in its first step.
///
/// Laws that hold (FrictionLaw::holding()) hold samples that were pressed at a step's end: by the
/// spring without limit, and by a second one for gap > 0. A touch above that traction is released
/// until it ends, and so are all touches of an obstacle without total pressure.
///
/// @pre `laws` outlives the response.
std::unique_ptr<Response> withFriction(std::unique_ptr<Response> normal,
                                       const ResponseSettings& settings,
                                       const FrictionList& laws = frictionList());

}  // namespace palpate::contact

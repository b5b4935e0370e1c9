// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/contact/response.h"

namespace palpate::contact {

/// Has what touches cling, beside what `normal` answers: by dry friction, and to teeth.
///
/// A touch is anchored where it began. Its spring, of a stiffness k and along the obstacle's
/// surface only, has the stretch d, the obstacle's motion included, and the energy
///
///   k d^2 / 2  up to the force L,  then  L (d - L / (2 k)):  the point slides along,
///
/// which is the return mapping of Coulomb's law [Wriggers 2006, Computational contact
/// mechanics], once continuously differentiable and convex. L = mu N with the normal force
/// N that the step is expected to end with, going on as in the last one; the solution is sought
/// again with that of the solution found, less a margin that grows, where friction is beyond mu N
/// there or a touch slips for the first time, from when on mu is the kinetic one until the spring
/// draws by less. So no stuck touch creeps, and none has more friction than Coulomb allows; what
/// little is left above that at the step's end is taken off what is reported. A touch is
/// frictionless in the step in which it begins.
///
/// Teeth hold what was pressed where a step ended, along the surface by the spring without L, and
/// away from it by another one for gap > 0. They let go of what draws by more than Friction::teeth
/// times its area, until that touch has ended, and of all that an obstacle holds where it presses
/// on it, as a whole, no more.
std::unique_ptr<Response> withFriction(std::unique_ptr<Response> normal,
                                       const ResponseSettings& settings);

}  // namespace palpate::contact

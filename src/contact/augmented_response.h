// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/contact/response.h"

namespace palpate::contact {

/// Frictionless, and without penetration where the tissue is at rest: the pressure at gap g is
///
///   p(s - g) + h(-g),   p and h the soft and the hard part of what Penalty gives,
///
/// where p(s) = lambda is the multiplier of the augmented Lagrangian [Hestenes 1969, Powell 1969;
/// of contact: Simo, Laursen 1992, box 3], here as a length, so that the blend of Penalty, which
/// has a second derivative, serves for it. After a step lambda grows towards the pressure that
/// pressed, so that from step to step g goes to zero. Of each obstacle it is a field of the
/// surface's nodes, which follow the mean of their samples: one of each sample would ask for more
/// than the nodes can do, and the multipliers would not come to rest [on stable choices: Fischer,
/// Wriggers 2005].
///
/// Where the penalty is soft beside the tissue, multipliers swing, and what nodes cannot say is
/// wrong by what the penalty gives way. So its stiffness is at least 300 E / l, with Young's
/// modulus E and edges l of the tissue there.
///
/// A multiplier follows the penetration from step to step as an integral does, which makes a mass m
/// that swings on the contact's stiffness k swing up, where steps of h damp it: by backward Euler
/// by k h^2 / 2 m of the swing, to first order, by BDF2 by (k h^2 / m)^2 / 4. So only half of (k /
/// (k + m / h^2))^2 of a change is taken over, m being thirty times the node's, for what lies under
/// it swings along. It is what rests that is to be without penetration: of a growth the part exp(-w
/// / 0.5 mm) of that is taken over where the surface has gone the way w in the step, beside what
/// the body has gone as a whole, and what is there fades by exp(-(u / 0.3 mm)^2) where it has
/// slipped by u, lest it press where the tool was.
std::unique_ptr<Response> makeAugmentedResponse(const ResponseSettings& settings);

}  // namespace palpate::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/contact/response.h"

namespace palpate::contact {

/// Frictionless, and without penetration where the tissue is at rest: the pressure at gap g is
///
///   p(s - g) + h(-g),   p and h the soft and the hard part of what Penalty gives,
///
/// where the shift s [m] is remembered: after a solution it grows towards the one at which the
/// pressure that pressed is reached without any penetration, so that from solution to solution g
/// goes to zero. It is the multiplier of the augmented Lagrangian [Hestenes 1969, Powell 1969; of
/// contact: Simo, Laursen 1992, box 3] as a length, so that the blend of Penalty, which has a
/// second derivative, serves for it. Of each obstacle it is a field of the surface's nodes, which
/// follow the mean of their samples: one of each sample would ask for more than the nodes can do,
/// and the multipliers would not come to rest [on stable choices: Fischer, Wriggers 2005].
///
/// A multiplier follows the penetration from step to step as an integral does, which makes a mass m
/// that swings on the contact's stiffness k swing up, where steps of h damp it by the factor 1 + k
/// h^2 / m. So only the part k / (k + m / h^2) of a change is taken over.
std::unique_ptr<Response> makeAugmentedResponse(const ResponseSettings& settings);

}  // namespace palpate::contact

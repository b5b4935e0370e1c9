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
/// of contact: Simo, Laursen 1992, box 3], expressed as a length s, for the C1 blend of Penalty.
/// After a step lambda moves towards the contact pressure, so that g tends to zero over steps.
/// Multipliers are nodal, per obstacle, by the mean of the samples; one per sample would
/// overconstrain the nodes and not converge [on stable choices: Fischer, Wriggers 2005].
///
/// The penalty stiffness is at least 300 E / l, with Young's modulus E and edge length l of the
/// tissue: a softer one lets multipliers oscillate.
///
/// Multipliers integrate the penetration over steps, which excites a mass m on the contact
/// stiffness k. Steps of h damp this motion by k h^2 / 2 m (backward Euler) or (k h^2 / m)^2 / 4
/// (BDF2). So changes are scaled by (k / (k + m / h^2))^2 / 2, with m thirty nodal masses for the
/// tissue below. Only resting contact must have no penetration. So an increase is scaled by exp(-w
/// / 0.5 mm), w: displacement in the step relative to the body. Multipliers decay by exp(-(u / 0.3
/// mm)^2) with the slip u: none remains where the tool has left.
std::unique_ptr<Response> makeAugmentedResponse(const ResponseSettings& settings);

}  // namespace palpate::contact

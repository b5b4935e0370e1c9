// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/contact/response.h"

namespace palpate::contact {

/// Frictionless: the energy area psi(-gap) of the pressure that Penalty gives, of `stiffness` and
/// `smoothing` of the settings.
std::unique_ptr<Response> makePenaltyResponse(const ResponseSettings& settings);

}  // namespace palpate::contact

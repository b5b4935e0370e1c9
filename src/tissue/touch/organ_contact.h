// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/interaction.h"

namespace palpate::tissue {

/// Organs touch each other, and themselves where the scene asks for it: contact::SurfaceContact
/// with stiffness and smoothing of contact with tools.
std::shared_ptr<const Interaction> makeOrganContact(const ModelSettings& settings);

}  // namespace palpate::tissue

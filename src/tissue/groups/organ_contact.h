// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/interaction.h"

namespace palpate::tissue {

/// Makes the interaction of organs in contact, and of organs in self-contact where the scene has
/// it: contact::SurfaceContact with stiffness and smoothing of tool contact.
std::shared_ptr<const Interaction> makeOrganContact(const ModelSettings& settings);

}  // namespace palpate::tissue

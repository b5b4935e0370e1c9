// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>

#include "palpate/tissue/model_description.h"
#include "tissue/organ/organ_bodies.h"

namespace palpate::tissue {

/// What the scene says to an organ's body, but for its element.
FemSettings settingsOf(const OrganDescription& organ, const ModelDescription& description);

/// The model of all organs, each made by `make`: of one that nothing else acts on, itself.
/// @throws what `make` throws; of several organs with the organ's name before it.
std::unique_ptr<TissueModel> makeOrgans(
    const ModelDescription& description,
    const std::function<std::unique_ptr<OrganBodies>(const OrganDescription&)>& make);

}  // namespace palpate::tissue

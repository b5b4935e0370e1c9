// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Model "cloth": a sheet of point masses and springs (sheetNetwork()) as thick as its settings
/// say, which tools touch from either side. It is moved, held, solved and stepped as model
/// mass_spring is, by the same schemes. Rolled up, its layers are kept apart
/// (contact::LayerContact); no other organ touches it.
/// @throws as makeFem(), sheetNetwork(), rolledUp() and SpringSteps; std::invalid_argument for
/// supports that need faces of a body, pressures, fibres, viscous terms and a mesh that adapts.
std::unique_ptr<TissueModel> makeCloth(const ModelDescription& description);

}  // namespace palpate::tissue

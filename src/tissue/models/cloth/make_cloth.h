// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Model "cloth": a sheet of point masses and springs (sheetNetwork()) with thickness, touched on
/// both sides. Integration, supports and solvers are those of mass_spring. A rolled sheet has layer
/// contact (contact::LayerContact); there is no contact with other organs.
/// @throws as makeFem(), sheetNetwork(), rolledUp() and SpringSteps; std::invalid_argument for
/// supports on faces, pressures, fibres, viscous terms and adaptation.
std::unique_ptr<TissueModel> makeCloth(const ModelDescription& description);

}  // namespace palpate::tissue

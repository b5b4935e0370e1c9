// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Model "enriched": finite elements with a fine surface for display and contact, whose detail is
/// learned from presses of finer elements [Bounik, Shamsi, Sedaaghi 2020].
/// @throws std::invalid_argument for unsupported descriptions, and as makeFemTissue().
std::unique_ptr<TissueModel> makeEnriched(const ModelDescription& description);

}  // namespace palpate::tissue

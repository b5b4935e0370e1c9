// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Model "enriched": finite elements that carry a finer surface, which is shown and felt, with what
/// presses of finer elements taught of its detail [Bounik, Shamsi, Sedaaghi 2020].
/// @throws std::invalid_argument for what it cannot treat, and as makeFemTissue().
std::unique_ptr<TissueModel> makeEnriched(const ModelDescription& description);

}  // namespace palpate::tissue

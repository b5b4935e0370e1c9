// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Model "neural" of one organ: what was learned of presses of it (NeuralSettings::file), and
/// finite elements (makeFem()) where a press is unlike those.
/// @throws std::invalid_argument for what was not learned or is of another body, InputError for the
/// file, and as makeFem().
std::unique_ptr<TissueModel> makeNeural(const ModelDescription& description);

}  // namespace palpate::tissue

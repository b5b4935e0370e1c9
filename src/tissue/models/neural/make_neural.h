// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Model "neural" of one organ: a surrogate learned from presses (NeuralSettings::file), and finite
/// elements (makeFem()) for presses outside its training data.
/// @throws std::invalid_argument for a surrogate of another body, InputError for the file, and as
/// makeFem().
std::unique_ptr<TissueModel> makeNeural(const ModelDescription& description);

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// What an organ may be modelled by; the first is the default.
std::vector<std::string> modelNames();

/// Whether one model of that name owns all organs of that name, solved together; otherwise each
/// organ has a model of its own.
bool ownsAllOrgans(const std::string& name);

/// @throws std::invalid_argument for an unknown name or what the model cannot treat,
/// std::runtime_error if it has no state to begin with, palpate::InputError as
/// OrganDescription.
std::unique_ptr<TissueModel> makeModel(const std::string& name,
                                       const ModelDescription& description);

}  // namespace palpate::tissue

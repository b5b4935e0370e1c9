// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Names of all tissue models; the first is the default.
std::vector<std::string> modelNames();

/// Whether one model owns all organs with the model name `name`; else each organ has its own model.
bool ownsAllOrgans(const std::string& name);

/// @throws std::invalid_argument for an unknown name or an unsupported description,
/// std::runtime_error if there is no equilibrium, palpate::InputError as OrganDescription.
std::unique_ptr<TissueModel> makeModel(const std::string& name,
                                       const ModelDescription& description);

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Model "fem" of one organ: finite elements in its tetrahedra, see makeIslands().
/// @throws as makeFemTissue() and OrganDescription.
std::unique_ptr<TissueModel> makeFem(const ModelDescription& description);

}  // namespace palpate::tissue

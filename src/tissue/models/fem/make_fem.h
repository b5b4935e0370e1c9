// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Model "fem": finite elements in the tetrahedra of each organ, see makeIslands(); organs between
/// which something may act are solved together, see makeFemOrgans().
/// @throws as makeFemTissue(), naming the organ where there are several, and OrganDescription.
std::unique_ptr<TissueModel> makeFem(const ModelDescription& description);

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Model "mass_spring": point masses at the corners of the organ's tetrahedra, and springs between
/// them (tetNetwork()). Organs of this model touch one another as those of finite elements do,
/// where they are solved implicitly.
/// @throws as makeFem(), makeCells(), tetNetwork() and SpringSteps
std::unique_ptr<TissueModel> makeMassSpring(const ModelDescription& description);

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Model "tensor_mass": TensorMassElasticity, solved as `solver` says: with `tled` in explicit
/// steps, as it was published.
/// @throws as makeFem() and makeCells()
std::unique_ptr<TissueModel> makeTensorMass(const ModelDescription& description);

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Model "hybrid" [Cotin, Delingette, Ayache 2000]: a part of tensors (TensorMassElasticity) that
/// moves with inertia, and a rest that is linear, quasi-static and solved for beforehand
/// (HybridElasticity), stepped as HybridSteps says.
/// @throws std::invalid_argument for an organ without `hybrid.region`, a rest that nothing holds,
/// needles, a loop that is not stable, and as HybridElasticity and HybridSteps do; else as
/// makeCells().
std::unique_ptr<TissueModel> makeHybrid(const ModelDescription& description);

}  // namespace palpate::tissue

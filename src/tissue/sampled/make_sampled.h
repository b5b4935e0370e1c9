// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Model "sampled_elasticity" of one organ [Debunne et al. 1999]: particles of an octree between
/// which umbrella operators act (Umbrella), in symplectic Euler steps, those of large particles
/// less often than those of small ones by powers of two; a surface that follows them, and is
/// touched. Displacements are small: a turn of the organ is a strain.
/// @throws std::invalid_argument for what it cannot treat: several solids, viscous ones, fibres,
/// adapt, supports that are not glue; an organ that gravity would drag away.
std::unique_ptr<TissueModel> makeSampledElasticity(const ModelDescription& description);

}  // namespace palpate::tissue

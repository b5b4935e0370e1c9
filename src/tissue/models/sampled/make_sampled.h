// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Model "sampled_elasticity" of one organ [Debunne et al. 1999]: particles of an octree with
/// umbrella operators (Umbrella), in symplectic Euler steps; large particles step less often, by
/// powers of two. The surface interpolates the particles and has contact. For small displacements:
/// rotations strain.
/// @throws std::invalid_argument for unsupported descriptions: several solids, viscous terms,
/// fibres, adaptation, supports other than glue; for supports that do not hold the organ under
/// gravity.
std::unique_ptr<TissueModel> makeSampledElasticity(const ModelDescription& description);

}  // namespace palpate::tissue

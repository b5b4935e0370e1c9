// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Model "bem" of one organ: linear elastostatics by boundary elements on its surface, no
/// tetrahedra (BemOrgan).
/// @throws std::invalid_argument for unsupported descriptions: several solids or bodies, fibres,
/// viscous terms, adaptation, needles, supports other than glue or with rigid motion, too many
/// points.
std::unique_ptr<TissueModel> makeBem(const ModelDescription& description);

}  // namespace palpate::tissue

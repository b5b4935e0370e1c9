// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Model "honeycomb" of one organ: cells of elastic walls with an incompressible fluid [Wang 2005,
/// chapter 3], of a grid in the organ's frame, with centres inside the organ.
/// @throws std::invalid_argument for unsupported descriptions and for cells without support,
/// std::runtime_error where there is no equilibrium under gravity.
std::unique_ptr<TissueModel> makeHoneycomb(const ModelDescription& description);

}  // namespace palpate::tissue

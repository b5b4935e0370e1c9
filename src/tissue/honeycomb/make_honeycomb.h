// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Model "honeycomb" of one organ: cells of elastic walls that are full of an incompressible fluid
/// [Wang 2005, chapter 3], those of a grid in the organ's frame whose centres are inside it.
/// @throws std::invalid_argument for what it cannot do and for cells that nothing holds,
/// std::runtime_error where there is no equilibrium under gravity.
std::unique_ptr<TissueModel> makeHoneycomb(const ModelDescription& description);

}  // namespace palpate::tissue

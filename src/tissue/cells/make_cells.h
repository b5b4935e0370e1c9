// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "palpate/tissue/model_description.h"
#include "tissue/fem/fem_organ.h"

namespace palpate::tissue {

/// What makes an organ's tetrahedra, in the world, elastic.
using PartsOf =
    std::function<OwnParts(const mesh::TetMesh&, const fem::Composition&, const OrganDescription&)>;

/// @throws std::invalid_argument for a mesh that adapts, and for solids with fibres or viscous
/// terms, which no model of CellElasticity knows.
void refuseForCells(const std::string& model, const OrganDescription& organ,
                    const fem::Composition& composition);

/// Organs of a model that treats tetrahedra in its own way, named `model`, but is otherwise moved,
/// held, touched and solved as finite elements are.
/// @throws std::invalid_argument, with the organ's name where there are several, as
/// refuseForCells(), and as `parts` does; else as makeFem().
std::unique_ptr<TissueModel> makeCells(const std::string& model,
                                       const ModelDescription& description, const PartsOf& parts);

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "palpate/tissue/model_description.h"
#include "tissue/organ/fem_organ.h"

namespace palpate::tissue {

/// Elasticity of an organ's tetrahedra, world, with its step method.
using PartsOf =
    std::function<OwnParts(const mesh::TetMesh&, const fem::Composition&, const OrganDescription&)>;

/// @throws std::invalid_argument for mesh adaptation, fibres or viscous terms, which CellElasticity
/// does not support.
void refuseForCells(const std::string& model, const OrganDescription& organ,
                    const fem::Composition& composition);

/// Makes organs of model `model` with an elasticity of its own; integration, supports, contact and
/// solvers are those of finite elements.
/// @throws std::invalid_argument, as refuseForCells() and `parts`, with the organ's name where
/// there are several; else as makeFem().
std::unique_ptr<TissueModel> makeCells(const std::string& model,
                                       const ModelDescription& description, const PartsOf& parts);

}  // namespace palpate::tissue

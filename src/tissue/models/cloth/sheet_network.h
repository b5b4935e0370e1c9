// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "palpate/mesh/surface_mesh.h"
#include "palpate/springs/spring_network.h"
#include "palpate/tissue/model_description.h"

namespace palpate::tissue {

/// A sheet of point masses and springs, in its own frame.
struct SheetNetwork {
  springs::SpringNetwork network;
  Eigen::Matrix3Xi triangles;  ///< Triangles, 3 x m.
};

/// Makes the sheet of an organ: equal triangles with springs::triangleSprings(), or the file's
/// triangles with springs::fitSheet() and matched means; constants may come from a file
/// (SpringSettings::constants). Without preload the remaining springs keep their stiffness. Masses
/// are by adjacent triangles. `notes` gets the quality of the fit.
/// @throws palpate::InputError as for files; std::invalid_argument naming the key, the value and
/// what is allowed, or as springs::triangleNetwork() and springs::fitSheet().
SheetNetwork sheetNetwork(const OrganDescription& organ, const material::Solid& solid,
                          std::vector<std::string>* notes);

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "palpate/mesh/surface_mesh.h"
#include "palpate/springs/spring_network.h"
#include "palpate/tissue/model_description.h"

namespace palpate::tissue {

/// A sheet of point masses and springs in its own frame.
struct SheetNetwork {
  springs::SpringNetwork network;
  Eigen::Matrix3Xi triangles;  ///< Between its points, 3 x m.
};

/// The sheet of an organ: of equal triangles, with the springs of springs::triangleSprings(), or
/// what its file has, fitted by springs::fitSheet() with its means matched; the constants of either
/// may come from a file (SpringSettings::constants). Without preload the springs that are left are
/// as stiff as with it. Masses are by the triangles around a point. How well it is fitted becomes
/// one of `notes`.
/// @throws palpate::InputError as for files; std::invalid_argument naming the key, the value and
/// what is allowed, or as springs::triangleNetwork() and springs::fitSheet().
SheetNetwork sheetNetwork(const OrganDescription& organ, const material::Solid& solid,
                          std::vector<std::string>* notes);

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/fem/composition.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/springs/spring_network.h"
#include "palpate/tissue/springs/spring_settings.h"

namespace palpate::tissue {

/// Springs between the points of tetrahedra, at rest in the world:
///
/// "volumes": an edge of length L with adjacent volume V has the stiffness E V / L^2, with the mean
/// E over V. With isotropic edge directions Young's modulus is E and Poisson's ratio 1/4 [Wang
/// 2005, (7.59)]. "fitted": springs::fitSolid() with its mean matched, times the mean E; `notes`
/// gets the quality of the fit. "file": what springs::readSprings() reads; damping, lengths and
/// preloads with it. Masses are a quarter of those of the tetrahedra around a point.
/// @throws palpate::InputError as readSprings(); std::invalid_argument for a file with other
/// points, by more than a thousandth of the mesh's size, or as fitSolid().
springs::SpringNetwork tetNetwork(const mesh::TetMesh& mesh, const Pose& X_WO,
                                  const fem::Composition& composition,
                                  const SpringSettings& settings, std::vector<std::string>* notes);

}  // namespace palpate::tissue

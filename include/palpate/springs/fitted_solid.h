// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/mesh/tet_mesh.h"
#include "palpate/springs/constraint_family.h"
#include "palpate/springs/spring_network.h"

namespace palpate::springs {

/// Springs and what they lack of their conditions.
struct SolidFit {
  SpringNetwork network;
  std::vector<ConstraintFamily> stiffness;
  int slack;    ///< Springs whose stiffness is 0, for it would be negative.
  int bounded;  ///< Springs as stiff as the step allows.
};

/// Springs without preload along the edges of tetrahedra, for an isotropic solid with Young's
/// modulus E and Poisson's ratio 1/4, the only one that they can have [Wang 2005, 7.2]. Over the
/// springs of a mass with the volume V, U long in direction e,
///
///     sum k U^2 e_i e_j e_k e_l = 4/5 E V (d_ij d_kl + d_ik d_jl + d_il d_jk),   0 <= k <= M
///
/// 15 conditions, which the 18 of (7.32-7.59) come to, in the least squares of the tensors' lengths
/// over that of the right side. Families are the tensor's parts that turn alike: `stretch`, sum k
/// U^2 = 12 E V (7.59), `direction` (7.52, 7.53) and `isotropy`. Corners only of quadratic
/// tetrahedra.
///
/// @throws std::invalid_argument naming a collapsed tetrahedron or a point of none, counted from 0,
/// or a constant that is not > 0; `density` [kg/m^3].
SolidFit fitSolid(const mesh::TetMesh& mesh, double young_modulus, double density,
                  const FitSettings& settings = {});

}  // namespace palpate::springs

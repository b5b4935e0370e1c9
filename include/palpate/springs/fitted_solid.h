// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/mesh/tet_mesh.h"
#include "palpate/springs/constraint_family.h"
#include "palpate/springs/spring_network.h"

namespace palpate::springs {

/// Springs, and the violation of their conditions.
struct SolidFit {
  SpringNetwork network;
  std::vector<ConstraintFamily> stiffness;
  int slack;    ///< Number of springs at the lower bound 0.
  int bounded;  ///< Number of springs at the bound of the step.
};

/// Springs without preload along the edges of tetrahedra, for an isotropic solid with Young's
/// modulus E and Poisson's ratio 1/4, the only possible one [Wang 2005, 7.2]. Over the springs of a
/// mass with the volume V, with length U and direction e,
///
///     sum k U^2 e_i e_j e_k e_l = 4/5 E V (d_ij d_kl + d_ik d_jl + d_il d_jk),   0 <= k <= M
///
/// These 15 conditions, equivalent to the 18 of (7.32-7.59), are least squares of tensor norms
/// relative to the right-hand side. Families are the tensor's rotation-invariant parts: `stretch`,
/// sum k U^2 = 12 E V (7.59), `direction` (7.52, 7.53) and `isotropy`. Quadratic tetrahedra count
/// by their corners.
///
/// @throws std::invalid_argument naming a collapsed tetrahedron or a point of none, counted from 0,
/// or a constant that is not > 0; `density` [kg/m^3].
SolidFit fitSolid(const mesh::TetMesh& mesh, double young_modulus, double density,
                  const FitSettings& settings = {});

}  // namespace palpate::springs

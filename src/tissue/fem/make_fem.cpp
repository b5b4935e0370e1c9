// SPDX-License-Identifier: GPL-3.0-or-later
#include "make_fem.h"

#include "adaptive_tissue.h"
#include "palpate/fem/elasticity.h"
#include "palpate/tissue/fem/islands.h"

namespace palpate::tissue {

std::unique_ptr<TissueModel> makeFem(const ModelDescription& description) {
  const OrganDescription& organ = description.organs.front();
  mesh::TetMesh mesh = fem::meshFor(organ.element, organ.tetrahedra());
  const fem::FreeMask free = organ.free(mesh.points);
  const fem::Composition composition = organ.composition(mesh);
  mesh.points = (organ.X_WO * mesh.points.colwise().homogeneous()).eval();
  FemSettings settings{description.settings};
  settings.element = organ.element;
  settings.mass_damping = organ.damping.mass;
  settings.stiffness_damping = organ.damping.stiffness;
  if (organ.adapt.on()) {
    return makeAdaptiveTissue(mesh, composition, free, settings, organ.adapt, description.pool);
  }
  return makeIslands(mesh, composition, free, settings, description.pool);
}

}  // namespace palpate::tissue

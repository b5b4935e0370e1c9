// SPDX-License-Identifier: GPL-3.0-or-later
#include "make_fem.h"

#include "palpate/fem/elasticity.h"
#include "tissue/adaptation/adaptive_tissue.h"
#include "tissue/groups/make_organs.h"

namespace palpate::tissue {

std::unique_ptr<TissueModel> makeFem(const ModelDescription& description) {
  return makeOrgans(
      description, [&](const OrganDescription& organ) -> std::unique_ptr<OrganBodies> {
        mesh::TetMesh mesh = fem::meshFor(organ.element, organ.tetrahedra());
        const Surroundings surroundings = organ.surroundings(mesh);
        const fem::Composition composition = organ.composition(mesh);
        mesh.points = (organ.X_WO * mesh.points.colwise().homogeneous()).eval();
        FemSettings settings = settingsOf(organ, description);
        settings.element = organ.element;
        if (organ.adapt.on()) {
          return makeAdaptiveTissue(mesh, composition, surroundings, settings, organ.adapt,
                                    description.pool);
        }
        return makeOrganBodies(mesh, composition, surroundings, settings, description.pool);
      });
}

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
#include "make_cells.h"

#include <stdexcept>
#include <utility>

#include "tissue/groups/fem_organs.h"
#include "tissue/groups/make_organs.h"

namespace palpate::tissue {

void refuseForCells(const std::string& model, const OrganDescription& organ,
                    const fem::Composition& composition) {
  if (organ.adapt.on()) {
    throw std::invalid_argument("adapt: the mesh of model " + model + " stays; leave adapt out");
  }
  if (!composition.frames.empty()) {
    throw std::invalid_argument("model " + model + " is the same in all directions; choose a law " +
                                "without fibres");
  }
  for (const material::Solid& solid : composition.solids) {
    if (!solid.prony.empty()) {
      throw std::invalid_argument("model " + model +
                                  " has no viscous memory; leave viscoelastic out");
    }
  }
}

std::unique_ptr<TissueModel> makeCells(const std::string& model,
                                       const ModelDescription& description, const PartsOf& parts) {
  return makeOrgans(description, [&](const OrganDescription& organ) {
    mesh::TetMesh mesh = organ.tetrahedra();
    const Surroundings surroundings = organ.surroundings(mesh);
    const fem::Composition composition = organ.composition(mesh);
    refuseForCells(model, organ, composition);
    mesh.points = (organ.X_WO * mesh.points.colwise().homogeneous()).eval();
    FemSettings settings = settingsOf(organ, description);
    const OwnParts own = parts(mesh, composition, organ);
    settings.element = own.name;
    return makeFemOrgan(mesh, composition, surroundings, settings, description.pool, own);
  });
}

}  // namespace palpate::tissue

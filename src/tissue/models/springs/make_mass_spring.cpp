// SPDX-License-Identifier: GPL-3.0-or-later
#include "make_mass_spring.h"

#include <limits>
#include <string>
#include <vector>

#include "spring_elasticity.h"
#include "spring_steps.h"
#include "tet_network.h"
#include "tissue/model_library.h"
#include "tissue/models/cells/make_cells.h"

namespace palpate::tissue {
namespace {

OwnParts partsOf(const mesh::TetMesh& mesh, const fem::Composition& composition,
                 const OrganDescription& organ) {
  std::vector<std::string> notes;
  const auto elasticity = std::make_shared<SpringElasticity>(
      mesh, composition, tetNetwork(mesh, organ.X_WO, composition, organ.springs, &notes));
  OwnParts parts{"mass_spring by " + organ.springs.scheme, elasticity, {}, notes};
  if (organ.springs.scheme == SpringSettings().scheme) return parts;
  SpringStepSettings settings{&springIntegrator(organ.springs.scheme), organ.springs.step,
                              organ.springs.region};
  if (settings.radius == 0.0) settings.radius = std::numeric_limits<double>::infinity();
  parts.method = [elasticity, settings](FemBody* body) {
    return std::make_unique<SpringSteps>(body, &elasticity->forces(), settings);
  };
  return parts;
}

}  // namespace

std::unique_ptr<TissueModel> makeMassSpring(const ModelDescription& description) {
  return makeCells("mass_spring", description, partsOf);
}

}  // namespace palpate::tissue

PALPATE_TISSUE_MODEL(mass_spring, palpate::tissue::makeMassSpring)

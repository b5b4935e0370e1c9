// SPDX-License-Identifier: GPL-3.0-or-later
#include "make_tensor_mass.h"

#include "tensor_mass_elasticity.h"
#include "tissue/model_library.h"
#include "tissue/models/cells/make_cells.h"

namespace palpate::tissue {

std::unique_ptr<TissueModel> makeTensorMass(const ModelDescription& description) {
  return makeCells(
      "tensor_mass", description,
      [](const mesh::TetMesh& mesh, const fem::Composition& composition, const OrganDescription&) {
        return OwnParts{
            "tensor_mass", std::make_shared<TensorMassElasticity>(mesh, composition), {}, {}};
      });
}

}  // namespace palpate::tissue

PALPATE_TISSUE_MODEL(tensor_mass, palpate::tissue::makeTensorMass)

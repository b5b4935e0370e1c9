// SPDX-License-Identifier: GPL-3.0-or-later
#include "make_neural.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "neural_organ.h"
#include "palpate/enrichment/surrogate_file.h"
#include "tissue/model_library.h"
#include "tissue/models/fem/make_fem.h"

namespace palpate::tissue {
namespace {

void refuse(const OrganDescription& organ, const ModelSettings& settings) {
  const auto no = [](const std::string& what) { throw std::invalid_argument(what); };
  if (organ.neural.file.empty()) {
    no("neural: file: is missing: model neural needs what `palpate train` made");
  }
  if (organ.adapt.on()) no("adapt: the mesh of model neural stays; leave adapt out");
  if (organ.element != fem::elementNames().front()) {
    no("element: model neural is of linear tetrahedra; must be " + fem::elementNames().front());
  }
  if (organ.friction.any()) no("model neural knows no friction; leave friction out");
  if (settings.needles) {
    no("model neural knows no needle that goes in; leave the instruments' needle out");
  }
}

}  // namespace

std::unique_ptr<TissueModel> makeNeural(const ModelDescription& description) {
  const OrganDescription& organ = description.organs.front();
  refuse(organ, description.settings);
  NeuralParts parts;
  parts.surrogate = enrichment::readSurrogate(organ.neural.file);
  parts.elements = makeFem(description);
  parts.X_WO = organ.X_WO;
  parts.body = parts.elements->cells(0);
  Points& X = parts.body.points;
  X = (organ.X_WO.inverse() * X.colwise().homogeneous()).eval();
  if (parts.body.cells.rows() != 4) {
    throw std::invalid_argument("element: model neural is of linear tetrahedra");
  }
  parts.free = organ.free(X);
  const std::string motions = fem::freeRigidMotions(X, parts.free);
  if (!motions.empty()) {
    throw std::invalid_argument("model neural needs an organ that its supports hold, they leave " +
                                motions);
  }
  for (const material::Solid& solid : organ.composition(mesh::TetMesh()).solids) {
    if (!solid.prony.empty()) {
      throw std::invalid_argument("model neural has no viscous memory; leave viscoelastic out");
    }
  }
  return std::make_unique<NeuralOrgan>(std::move(parts), organ.neural, description.settings);
}

}  // namespace palpate::tissue

PALPATE_TISSUE_MODEL(neural, palpate::tissue::makeNeural)

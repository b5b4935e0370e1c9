// SPDX-License-Identifier: GPL-3.0-or-later
#include "make_sampled.h"

#include <algorithm>
#include <stdexcept>

#include "sampled_tissue.h"
#include "tissue/model_library.h"

namespace palpate::tissue {
namespace {

constexpr double kContact =
    100.0;  // contact stiffness over shear modulus per particle distance [-]

}  // namespace

std::unique_ptr<TissueModel> makeSampledElasticity(const ModelDescription& description) {
  const OrganDescription& organ = description.organs.front();
  if (organ.adapt.on()) {
    throw std::invalid_argument(
        "adapt: particles of model sampled_elasticity are parted as `sampling` says; leave it out");
  }
  mesh::TetMesh mesh = organ.tetrahedra();
  const fem::FreeMask free = organ.free(mesh.points);
  const fem::Composition composition = organ.composition(mesh);
  if (composition.solids.size() > 1 || !composition.frames.empty()) {
    throw std::invalid_argument("model sampled_elasticity has one solid, without fibres");
  }
  if (!composition.solids.front().prony.empty()) {
    throw std::invalid_argument(
        "model sampled_elasticity has no viscous memory; leave viscoelastic out");
  }
  mesh.points = (organ.X_WO * mesh.points.colwise().homogeneous()).eval();
  const std::string motions = fem::freeRigidMotions(mesh.points, free);
  if (!motions.empty() && !description.settings.gravity.isZero()) {
    throw std::invalid_argument("gravity would move the organ, its supports leave " + motions);
  }
  // Contact is soft, since it bounds the step; multipliers remove the penetration.
  ModelSettings settings = description.settings;
  const material::Solid& solid = composition.solids.front();
  settings.contact.stiffness =
      std::min(settings.contact.stiffness,
               kContact * material::moduli(solid.law).mu / SampledTissue::finestOf(organ.sampling));
  return std::make_unique<SampledTissue>(mesh, free, solid, organ, settings);
}

}  // namespace palpate::tissue

PALPATE_TISSUE_MODEL(sampled_elasticity, palpate::tissue::makeSampledElasticity)

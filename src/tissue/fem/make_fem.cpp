// SPDX-License-Identifier: GPL-3.0-or-later
#include "make_fem.h"

#include <stdexcept>

#include "adaptive_tissue.h"
#include "fem_organs.h"
#include "palpate/base/error.h"
#include "palpate/fem/elasticity.h"

namespace palpate::tissue {
namespace {

std::unique_ptr<OrganBodies> makeOrgan(const OrganDescription& organ,
                                       const ModelDescription& description) {
  mesh::TetMesh mesh = fem::meshFor(organ.element, organ.tetrahedra());
  const Surroundings surroundings = organ.surroundings(mesh);
  const fem::Composition composition = organ.composition(mesh);
  mesh.points = (organ.X_WO * mesh.points.colwise().homogeneous()).eval();
  FemSettings settings{description.settings};
  settings.contact.friction_with = organ.friction;
  settings.element = organ.element;
  settings.mass_damping = organ.damping.mass;
  settings.stiffness_damping = organ.damping.stiffness;
  if (organ.adapt.on()) {
    return makeAdaptiveTissue(mesh, composition, surroundings, settings, organ.adapt,
                              description.pool);
  }
  return makeOrganBodies(mesh, composition, surroundings, settings, description.pool);
}

}  // namespace

std::unique_ptr<TissueModel> makeFem(const ModelDescription& description) {
  const ModelSettings& settings = description.settings;
  const bool acting = settings.touching.organs && !settings.interactions.empty();
  if (description.organs.size() == 1 && !acting) {
    return makeOrgan(description.organs.front(), description);
  }
  std::vector<NamedOrgan> organs;
  for (const OrganDescription& organ : description.organs) {
    const std::string of = "organ " + organ.name + ": ";
    try {
      organs.push_back({organ.name, makeOrgan(organ, description)});
    } catch (const InputError&) {
      throw;
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(of + error.what());
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(of + error.what());
    }
  }
  return makeFemOrgans(std::move(organs), settings);
}

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
#include "make_enriched.h"

#include <stdexcept>
#include <utility>

#include "enriched_organ.h"
#include "palpate/contact/contact_models.h"
#include "tissue/groups/fem_organs.h"
#include "tissue/groups/make_organs.h"
#include "tissue/model_library.h"

namespace palpate::tissue {
namespace {

void refuse(const OrganDescription& organ, const FemSettings& settings) {
  if (organ.adapt.on()) {
    throw std::invalid_argument(
        "adapt: the elements of model enriched stay; leave adapt out, or take model fem");
  }
  if (contact::isPrescribed(settings.contact)) {
    throw std::invalid_argument(
        "contact.model = prescribed: model enriched is felt at points of its fine surface; choose "
        "another one");
  }
}

}  // namespace

std::unique_ptr<TissueModel> makeEnriched(const ModelDescription& description) {
  return makeOrgans(
      description, [&](const OrganDescription& organ) -> std::unique_ptr<OrganBodies> {
        FemSettings settings = settingsOf(organ, description);
        settings.element = organ.element;
        refuse(organ, settings);
        const enrichment::DeformationDatabase database = organ.deformations();
        mesh::TetMesh mesh = fem::meshFor(organ.element, organ.tetrahedra());
        const Surroundings surroundings = organ.surroundings(mesh);
        const fem::Composition composition = organ.composition(mesh);
        mesh.points = (organ.X_WO * mesh.points.colwise().homogeneous()).eval();
        const mesh::SurfaceMesh boundary{mesh.points, mesh::trianglesOf(mesh::boundaryFaces(mesh))};
        FineSurface fine(
            boundary,
            {organ.X_WO * database.fine.points.colwise().homogeneous(), database.fine.triangles},
            settings.sample_spacing.finest());
        LearnedDetail learned(organ.enriched, database, organ.X_WO, boundary);
        OwnParts own;
        own.samples = fine.samples();
        return std::make_unique<EnrichedOrgan>(
            makeFemOrgan(mesh, composition, surroundings, settings, description.pool, own),
            std::move(fine), std::move(learned), organ.enriched.time);
      });
}

}  // namespace palpate::tissue

PALPATE_TISSUE_MODEL(enriched, palpate::tissue::makeEnriched)

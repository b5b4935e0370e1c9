// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/enrichment/database_plan.h"
#include "palpate/enrichment/sample_maker.h"
#include "palpate/mesh/volume_mesher.h"
#include "palpate/scene/scene.h"
#include "palpate/tissue/model_description.h"

namespace palpate::scene {

/// An organ of a scene for a database of presses: its surfaces, and a finite element body with its
/// material, element and supports, in the organ's frame, without gravity.
struct PressedOrgan {
  enrichment::PressedSurfaces surfaces;
  Eigen::Index nodes = 0, tetrahedra = 0;  ///< Of the body.
};

/// `description`: of the organ. `progress`: of meshing.
/// @throws InputError for an organ that cannot be pressed, std::invalid_argument for an
/// impossible number of coarse triangles.
PressedOrgan describePresses(const Scene& scene, int index,
                             const tissue::OrganDescription& description,
                             const enrichment::DatabasePlan& plan,
                             const mesh::MeshingProgress& progress);

}  // namespace palpate::scene

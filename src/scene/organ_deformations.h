// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/enrichment/deformations.h"
#include "palpate/scene/organ_assembly.h"

namespace palpate::scene {

/// Training data of an organ of model enriched, in the organ's frame: the named database, or one
/// made by its settings in the user's cache, where an interrupted run is resumed.
/// @throws InputError
enrichment::DeformationDatabase organDeformations(const Scene& scene, int index,
                                                  const Progress& progress,
                                                  std::vector<std::string>* warnings);

}  // namespace palpate::scene

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/enrichment/deformations.h"
#include "palpate/scene/organ_assembly.h"

namespace palpate::scene {

/// What an organ of model enriched learns from, in its own frame: the database that it names, or
/// one that is made as it says and kept in the user's cache, where a run that ends early is gone on
/// with.
/// @throws InputError
enrichment::DeformationDatabase organDeformations(const Scene& scene, int index,
                                                  const Progress& progress,
                                                  std::vector<std::string>* warnings);

}  // namespace palpate::scene

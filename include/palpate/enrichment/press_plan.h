// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "palpate/enrichment/deformations.h"

namespace palpate::enrichment {

/// Random presses of a surface. Each is independent of the others, so subsets can be made anywhere.
struct PressPlan {
  int seed = 1;
  double force = 1.0;       ///< Largest force [N]; the smallest is a quarter of it.
  double cone = 0.5235988;  ///< Largest angle to the inward normal [rad].
};

/// Press number `index` of a coarse surface, at one of the points `contacts`, without displacements
/// yet. Equal plans, points and indices give equal bits.
Deformation drawPress(const PressPlan& plan, const mesh::SurfaceMesh& coarse,
                      const std::vector<int>& contacts, int index);

}  // namespace palpate::enrichment

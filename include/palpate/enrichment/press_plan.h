// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "palpate/enrichment/deformations.h"

namespace palpate::enrichment {

/// How presses of a surface are drawn at random; each by itself, so that any part of them can be
/// made anywhere.
struct PressPlan {
  int seed = 1;
  double force = 1.0;       ///< The largest [N]; the smallest is a quarter of it.
  double cone = 0.5235988;  ///< Largest angle to the inward normal [rad].
};

/// Number `index` of the presses of a coarse surface, at one of the points `contacts`; nothing
/// moves yet. The same plan, points and index: the same bits.
Deformation drawPress(const PressPlan& plan, const mesh::SurfaceMesh& coarse,
                      const std::vector<int>& contacts, int index);

}  // namespace palpate::enrichment

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "palpate/enrichment/press_plan.h"

namespace palpate::enrichment {

/// Of which surfaces, and how often pressed, a database of an organ's deformations is made.
struct DatabasePlan {
  int samples = 60;
  int triangles = 276;                ///< Of the coarse surface.
  int splits = 2;                     ///< Of each of them, to the fine one.
  std::optional<double> edge_length;  ///< Of tetrahedra [m]; else the fine surface's mean.
  std::optional<double> patch;        ///< [m]; else the coarse surface's mean edge.
  PressPlan press;
};

}  // namespace palpate::enrichment

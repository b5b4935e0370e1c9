// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "palpate/enrichment/press_plan.h"

namespace palpate::enrichment {

/// Region of the pressed points: a ball in the organ's frame [m].
struct PressBall {
  Vec3 center = Vec3::Zero();
  double radius = 0.0;
};

/// Surfaces and presses of a database of deformations.
struct DatabasePlan {
  int samples = 60;
  int triangles = 276;                ///< Of the coarse surface.
  int splits = 2;                     ///< Of each coarse triangle, for the fine surface.
  std::optional<double> edge_length;  ///< Of tetrahedra [m]; default: the fine surface's mean.
  std::optional<double> patch;        ///< Radius [m]; default: the coarse surface's mean edge.
  std::optional<PressBall> within;    ///< Restricts the pressed points; default: all.
  PressPlan press;
};

}  // namespace palpate::enrichment

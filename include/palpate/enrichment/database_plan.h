// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "palpate/enrichment/press_plan.h"

namespace palpate::enrichment {

/// Which points of a surface are pressed: those in a ball, in the organ's frame [m].
struct PressBall {
  Vec3 center = Vec3::Zero();
  double radius = 0.0;
};

/// Of which surfaces, and how often pressed, a database of an organ's deformations is made.
struct DatabasePlan {
  int samples = 60;
  int triangles = 276;                ///< Of the coarse surface.
  int splits = 2;                     ///< Of each of them, to the fine one.
  std::optional<double> edge_length;  ///< Of tetrahedra [m]; else the fine surface's mean.
  std::optional<double> patch;        ///< [m]; else the coarse surface's mean edge.
  std::optional<PressBall> within;    ///< Only there; else everywhere.
  PressPlan press;
};

}  // namespace palpate::enrichment

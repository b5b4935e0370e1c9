// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/touch_balls.h"

namespace palpate::contact {

/// Balls inside a shape that touch its surface from within and meet faces that are large against
/// it: of a sphere itself, of a thin round one those along its axis, of others those in its
/// corners, along its edges and, where it is thin, in between. Corners are rounded off with a
/// radius of kRounding or, where the shape is thinner, its half thickness.
std::vector<TouchBall> faceBalls(const instrument::Geometry& geometry);

constexpr double kRounding = 2e-4;  ///< [m]
/// Shapes whose inscribed radius is less are thin [m].
constexpr double kThin = 1.5e-3;

/// Whether it is a sphere or a capsule, whose balls are those along its axis.
bool isRound(const instrument::Geometry& geometry);

/// Whether these balls are all over the surface.
bool coverAll(const instrument::Geometry& geometry);

/// From how large a distance of its samples on [m] a surface should be met by a shape's balls.
double resolutionOf(const instrument::Geometry& geometry);

}  // namespace palpate::contact

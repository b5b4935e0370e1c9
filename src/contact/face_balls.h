// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/touch_balls.h"

namespace palpate::contact {

/// Balls inscribed in a shape for contact with triangles larger than the shape: a sphere itself,
/// balls along the axis of a thin capsule, balls in corners and along edges of other shapes, and
/// between them where thin. Radius: kRounding, or half the thickness if less.
std::vector<TouchBall> faceBalls(const instrument::Geometry& geometry);

constexpr double kRounding = 2e-4;  ///< Radius at corners and edges [m].
/// Inscribed radius below which a shape is thin [m].
constexpr double kThin = 1.5e-3;

/// Whether a shape is a sphere or a capsule.
bool isRound(const instrument::Geometry& geometry);

/// Whether faceBalls() cover the whole surface.
bool coverAll(const instrument::Geometry& geometry);

/// Sample spacing above which a surface needs contact with the shape's balls [m].
double resolutionOf(const instrument::Geometry& geometry);

}  // namespace palpate::contact

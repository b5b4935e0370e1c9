// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/torture/draw.h"
#include "palpate/torture/torture_scene.h"

namespace palpate::torture {

/// Draws the scene's tools, in number and size as its category needs.
void drawTools(Draw* draw, TortureScene* scene);

/// Draws tool paths to, through and away from the organs, then rows until everything rests:
/// `trajectory`, `leave`, `rests`, `step`. `dt`: time between rows [s].
void drawMotion(double dt, Draw* draw, TortureScene* scene);

}  // namespace palpate::torture

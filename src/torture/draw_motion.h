// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/torture/draw.h"
#include "palpate/torture/torture_scene.h"

namespace palpate::torture {

/// The scene's tools, as many and as large as its category wants.
void drawTools(Draw* draw, TortureScene* scene);

/// The way of its tools to, through and away from the organs, and then nothing until they rest:
/// `trajectory`, `leave`, `rests`, `step`. `dt`: time between rows [s].
void drawMotion(double dt, Draw* draw, TortureScene* scene);

}  // namespace palpate::torture

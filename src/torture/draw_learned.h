// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/torture/draw.h"
#include "palpate/torture/torture_scene.h"

namespace palpate::torture {

/// Gives the organs of some scenes the models enriched and neural.
void drawLearning(TortureScene* scene);

/// Gives some scenes contact.model prescribed, with one segment (a cylinder's axis) and one organ
/// of linear tetrahedra.
void drawPrescribed(TortureScene* scene);

/// Gives other scenes contact.model penalty.
void drawPenalty(TortureScene* scene);

}  // namespace palpate::torture

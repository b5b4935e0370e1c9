// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/torture/draw.h"
#include "palpate/torture/torture_scene.h"

namespace palpate::torture {

/// Makes the organs of some scenes ones of models enriched and neural.
void drawLearning(TortureScene* scene);

/// Makes some scenes ones of contact.model prescribed: of one segment, the axis of a cylinder, and
/// one organ of linear tetrahedra.
void drawPrescribed(TortureScene* scene);

/// Makes others ones of contact.model penalty.
void drawPenalty(TortureScene* scene);

}  // namespace palpate::torture

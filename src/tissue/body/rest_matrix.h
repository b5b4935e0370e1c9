// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fem_body.h"

namespace palpate::tissue {

/// Assembles the stiffness A of the first step from rest, without contact. The elasticity keeps the
/// state before a step.
void assembleAtRest(FemBody* body, fem::Stiffness* A);

}  // namespace palpate::tissue

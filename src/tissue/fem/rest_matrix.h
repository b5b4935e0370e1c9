// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fem_body.h"

namespace palpate::tissue {

/// A = the matrix of the first step from rest, without contact. The body's elasticity is as if no
/// step had begun.
void assembleAtRest(FemBody* body, fem::Stiffness* A);

}  // namespace palpate::tissue

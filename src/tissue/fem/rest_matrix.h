// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fem_body.h"

namespace palpate::tissue {

/// The matrix of the first step from rest, without contact. The body's elasticity is as if no step
/// had begun.
fem::Stiffness restMatrix(FemBody* body);

}  // namespace palpate::tissue

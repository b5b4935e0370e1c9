// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/keys/fields.h"
#include "palpate/solver/integrator.h"

namespace palpate::solver {

void describe(keys::FieldVisitor& v, RayleighDamping& damping);

}  // namespace palpate::solver

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/keys/fields.h"
#include "palpate/material/solid.h"

namespace palpate::material {

void describe(keys::FieldVisitor& v, PronyTerm& term);

}  // namespace palpate::material

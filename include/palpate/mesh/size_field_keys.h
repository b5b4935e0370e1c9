// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/keys/fields.h"
#include "palpate/mesh/size_field.h"

namespace palpate::mesh {

/// The lengths that an edge may be asked to have [m].
inline keys::Range edgeLengthRange() { return keys::Range::closed(1.0e-4, 1.0); }

// The keys of a size field, the same in every kind of file.
void describe(keys::FieldVisitor& v, SizeField& field);
void describe(keys::FieldVisitor& v, FinePlace& place);

}  // namespace palpate::mesh

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/keys/fields.h"
#include "palpate/mesh/selection.h"

namespace palpate::mesh {

// The keys that select points or tetrahedra, the same in every kind of file.
void describe(keys::FieldVisitor& v, Region& region);
void describe(keys::FieldVisitor& v, PlaneRegion& plane);
void describe(keys::FieldVisitor& v, BoxRegion& box);
void describe(keys::FieldVisitor& v, SphereRegion& sphere);
void describe(keys::FieldVisitor& v, TetRegion& region);
void describe(keys::FieldVisitor& v, HalfSpaceRegion& half_space);
void describe(keys::FieldVisitor& v, CellDataRegion& cell_data);
void describe(keys::FieldVisitor& v, DepthRegion& depth);

}  // namespace palpate::mesh

// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/adapt_settings.h"

namespace palpate::tissue {

void describe(keys::FieldVisitor& v, AdaptSettings& adapt) {
  v.number({"finest", "m",
            "Edge length of the tetrahedra at a tool: a third of its radius, with `tet10` and "
            "`tet10p` two thirds, "
            "gives a force within a tenth; 0: the mesh never changes."},
           adapt.finest, keys::Range::closed(0.0, 1.0));
  v.number({"growth", "",
            "How much longer edges are in a metre of distance from the tool, until they are those "
            "of the mesh."},
           adapt.growth, keys::Range::closed(0.05, 10.0));
}

}  // namespace palpate::tissue

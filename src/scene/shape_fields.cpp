// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of what is rigid.
#include "palpate/scene/scene_fields.h"

namespace palpate::scene {

void describe(keys::FieldVisitor& v, MeshShapeConfig& shape) {
  v.flag({"convex_hull", "",
          "Take its convex hull, which fills notches and holes. Else its distance is sampled on a "
          "grid, as the next keys say."},
         shape.convex_hull);
  v.integer({"cells", "", "Cells of the grid over the mesh's diagonal, to begin with."},
            shape.cells, keys::Range::closed(8, 1000));
  v.number({"error", "m",
            "The grid is made finer until its distance is nowhere near the surface found to be off "
            "by more,"},
           shape.error, keys::Range::above(0.0, 0.1));
  v.number({"memory", "MB", "or has this size; a note then says how far it is off."}, shape.memory,
           keys::Range::above(0.0, 16000.0));
}

}  // namespace palpate::scene

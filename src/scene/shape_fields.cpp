// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of rigid shapes.
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

void describe(keys::FieldVisitor& v, AnatomyConfig& anatomy) {
  v.name({"name", "", "Names it in pictures and messages.", keys::Need::kRequired}, anatomy.name);
  v.text({"surface", "",
          "Closed surface: .obj, .off, .stl, .ply or .wrl; a path from the scene's folder, "
          "absolute, `file://` or `package://`.",
          keys::Need::kRequired},
         anatomy.surface);
  v.number({"scale", "", "Metres in one unit of the file: 0.001 for a mesh in millimetres."},
           anatomy.scale, keys::Range::above(0.0, 1.0e6));
  v.section({"pose", "", "Its frame in the world."}, anatomy.pose);
  v.number({"stiffness", "N/m",
            "Of what a tool that presses on it feels, at a single point. Organs rest on it by "
            "`contact.stiffness`."},
           anatomy.felt_stiffness, keys::Range::above(0.0, 1.0e5));
  v.section({"shape", "", "How its surface is taken where it is not convex."}, anatomy.shape);
}

}  // namespace palpate::scene

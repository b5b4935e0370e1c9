// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/cloth/cloth_settings.h"

namespace palpate::tissue {

void describe(keys::FieldVisitor& v, RolledSettings& rolled) {
  v.number({"radius", "m", "Of the outermost layer."}, rolled.radius, keys::Range::above(0.0, 1.0));
  v.number({"loss", "", "Part of the radius that is lost in a radian, from the outside in."},
           rolled.loss, keys::Range::closed(0.0, 0.5));
  v.number({"gap_least", "m", "Layers come no nearer to one another."}, rolled.gap_least,
           keys::Range::closed(0.0, 0.1));
  v.number({"gap_most", "m", "Layers that are farther apart do not act on one another."},
           rolled.gap_most, keys::Range::above(0.0, 0.1));
  v.rule(rolled.gap_least < rolled.gap_most, "gap_least", "must be less than gap_most");
}

void describe(keys::FieldVisitor& v, ClothSettings& cloth) {
  v.number({"thickness", "m", "Of the sheet; model `cloth` needs it."}, cloth.thickness,
           keys::Range::closed(0.0, 0.1));
  v.flag({"preload", "",
          "Springs are under preload, by which the sheet resists to be bent; without it bending "
          "costs nothing."},
         cloth.preload);
  const bool width = v.number({"width", "m",
                               "Along x, of a rectangle at z = 0 that is made in the place of a "
                               "`surface`, of equal triangles."},
                              cloth.width, keys::Range::closed(0.0, 10.0));
  const bool length = v.number({"length", "m", "Along y, to the nearest row of triangles."},
                               cloth.length, keys::Range::closed(0.0, 10.0));
  const bool spacing = v.number({"spacing", "m", "Of its points; a width is a multiple of it."},
                                cloth.spacing, keys::Range::closed(0.0, 1.0));
  v.rule(width == length && length == spacing, "", "needs all of width, length, spacing, or none");
  v.section({"rolled", "",
             "A flat sheet begins rolled up, from its edge of least y, which stays in its place, "
             "around an axis along x above it; if the section is there."},
            cloth.rolled);
}

}  // namespace palpate::tissue

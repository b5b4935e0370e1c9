// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/enriched/enriched_settings.h"

namespace palpate::tissue {

void describe(keys::FieldVisitor& v, EnrichedSettings& enriched) {
  v.choice(
      {"detail", "",
       "What samples add to the fine surface where a tool touches: `residual`, what "
       "interpolation of the elements' surface leaves out; `displacement`, nearly as published, "
       "a mean of samples in its place, as deep as the elements' surface; `none`: interpolation "
       "alone."},
      enriched.detail, {"residual", "displacement", "none"});
  const bool database = v.text({"database", "",
                                "Folder as `palpate database` makes it; a path as for `surface`. "
                                "Without it the samples are made when the scene is first loaded, "
                                "and kept beside the cached meshes."},
                               enriched.database);
  v.integer({"samples", "", "How many presses are solved for that."}, enriched.plan.samples,
            keys::Range::closed(1, 100000));
  v.number({"force", "N", "The largest press; the smallest is a quarter of it."},
           enriched.plan.press.force, keys::Range::above(0.0, 1000.0));
  v.integer({"seed", "", "Of the presses."}, enriched.plan.press.seed,
            keys::Range::closed(0, 2147483647));
  v.number(
      {"patch", "m",
       "Radius of what is pressed, best that of the tool; without it the coarse surface's mean "
       "edge."},
      enriched.plan.patch, keys::Range::above(0.0, 1.0));
  v.integer({"triangles", "", "Of the coarse surface that samples are compared on; even."},
            enriched.plan.triangles, keys::Range::closed(4, 100000));
  v.integer({"splits", "", "How often each of them is cut in four, to the fine surface."},
            enriched.plan.splits, keys::Range::closed(0, 5));
  v.rule(!database || !enriched.database.empty(), "database", "must not be empty");
  v.number({"sigma", "", "Width of the kernels, in spreads of the samples."}, enriched.sigma,
           keys::Range::above(0.0, 100.0));
  v.number({"time", "s", "In which detail comes and goes, so that the force does not jump."},
           enriched.time, keys::Range::closed(0.001, 10.0));
}

}  // namespace palpate::tissue

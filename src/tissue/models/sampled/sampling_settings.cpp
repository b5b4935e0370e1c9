// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/sampled/sampling_settings.h"

namespace palpate::tissue {

void describe(keys::FieldVisitor& v, SamplingSettings& sampling) {
  v.number({"coarsest", "m", "Distance of the particles where nothing bends."}, sampling.coarsest,
           keys::Range::closed(1e-4, 1.0));
  v.integer({"levels", "", "It is halved so many times, less one, where the tissue bends."},
            sampling.levels, keys::Range::closed(1, 5));
  v.number({"refine_above", "m",
            "A particle becomes up to eight where h^2 times the Laplacian of the displacement "
            "exceeds this, h being the distance to its neighbours."},
           sampling.refine_above, keys::Range::above(0.0, 1.0));
  v.number({"coarsen_below", "m", "Eight become one where it would be below this."},
           sampling.coarsen_below, keys::Range::closed(0.0, 1.0));
  v.rule(sampling.coarsen_below < sampling.refine_above, "coarsen_below",
         "must be less than refine_above");
  v.choice({"weights", "",
            "Of the umbrella operators: `published`, or `consistent`, of elasticity's own size and "
            "the same for both of a pair."},
           sampling.weights, {"consistent", "published"});
  v.number({"max_velocity_change", "m/s",
            "Sub-steps are so short that no particle's changes by "
            "more, at most 20000 a cycle, which ends with `iteration_limit` where these do not "
            "suffice; 0: by any."},
           sampling.max_velocity_change, keys::Range::closed(0.0, 100.0));
}

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/keys/fields.h"

namespace palpate::tissue {

/// Of an organ of model sampled_elasticity: where its particles are, and what acts between them.
struct SamplingSettings {
  double coarsest = 0.01;              ///< Distance of the particles at rest [m].
  int levels = 2;                      ///< Times that it can be halved, and one.
  double refine_above = 2.0e-4;        ///< h^2 |Laplacian of displacement|, h the distance [m].
  double coarsen_below = 5.0e-5;       ///< Likewise; less than refine_above.
  std::string weights = "consistent";  ///< consistent | published
  double max_velocity_change = 0.0;    ///< In a sub-step [m/s]; 0: any.
};

void describe(keys::FieldVisitor& v, SamplingSettings& sampling);

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/hybrid/hybrid_settings.h"

#include "palpate/mesh/selection_keys.h"

namespace palpate::tissue {

void describe(keys::FieldVisitor& v, HybridSettings& hybrid) {
  v.section({"region", "",
             "Tetrahedra that move as those of `tensor_mass`, by their centroid unless it says "
             "otherwise, in the organ's frame; model `hybrid` needs it. The others are linear, "
             "without inertia, and solved for beforehand."},
            hybrid.region);
  v.choice({"exchange", "",
            "`monolithic`: both are solved together; `loop`: each cycle the rest gets the "
            "displacements of the points that both share, and gives the forces there."},
           hybrid.exchange, {"monolithic", "loop"});
}

}  // namespace palpate::tissue

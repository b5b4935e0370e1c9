// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/honeycomb/honeycomb_settings.h"

namespace palpate::tissue {

std::vector<std::string> honeycombVolumeNames() { return {"linear", "exact"}; }

std::vector<std::string> honeycombWaveNames() { return {"there_back", "outward"}; }

void describe(keys::FieldVisitor& v, HoneycombSettings& honeycomb) {
  v.number({"cell_size", "m", "Edge of a cell; each axis of the organ's box gets a whole number."},
           honeycomb.cell_size, keys::Range::closed(1.0e-4, 1.0));
  v.choice({"volume", "",
            "Of a cell, and the areas that its pressure acts on: `linear` in the displacements, or "
            "`exact`."},
           honeycomb.volume, honeycombVolumeNames());
  v.choice({"waves", "",
            "How the solve goes through the cells: from the sides that are touched `outward`, "
            "sides that a wave has moved being prescribed to the cells behind; or `there_back`, "
            "each cell moving all of its sides."},
           honeycomb.waves, honeycombWaveNames());
  v.integer({"mixing", "", "Earlier waves that the next state is mixed from; 0: none."},
            honeycomb.mixing, keys::Range::closed(0, 20));
  v.number({"threshold", "m",
            "A solve ends when no side moves farther in a wave, and what is unbalanced would move "
            "none farther."},
           honeycomb.threshold, keys::Range::above(0.0, 0.01));
  v.number({"cut_off", "m",
            "Cells whose sides have moved less are left out, and the forces there let be; 0: "
            "none."},
           honeycomb.cut_off, keys::Range::closed(0.0, 0.01));
  v.integer({"max_sweeps", "", "Waves in a solve; one that takes more has not converged."},
            honeycomb.max_sweeps, keys::Range::closed(1, 100000));
}

}  // namespace palpate::tissue

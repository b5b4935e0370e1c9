// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/keys/fields.h"

namespace palpate::tissue {

/// How an organ of model honeycomb is made of cells, and how they are solved.
struct HoneycombSettings {
  double cell_size = 0.01;           ///< Edge of a cell, to fit the organ's box evenly [m].
  std::string volume = "linear";     ///< One of honeycombVolumeNames().
  std::string waves = "there_back";  ///< One of honeycombWaveNames().
  int mixing = 10;                   ///< Earlier waves that the next state is mixed from; 0: none.
  double threshold = 1.0e-6;  ///< Of a side's change in a wave, and of what is unbalanced [m].
  double cut_off = 0.0;       ///< Cells whose sides have moved less are left out [m]; 0: none.
  int max_sweeps = 100;       ///< Waves in a solve.
};

/// {"linear", "exact"}
std::vector<std::string> honeycombVolumeNames();
/// {"there_back", "outward"}
std::vector<std::string> honeycombWaveNames();

void describe(keys::FieldVisitor& v, HoneycombSettings& honeycomb);

}  // namespace palpate::tissue

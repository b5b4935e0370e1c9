// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/keys/fields.h"

namespace palpate::tissue {

/// Of an organ of model neural: what copies its answer to a press, and how finite elements take
/// over.
struct NeuralSettings {
  std::string file;          ///< Of enrichment::writeSurrogate().
  double switch_time = 0.1;  ///< From one to the other, at least [s].
};

void describe(keys::FieldVisitor& v, NeuralSettings& neural);

}  // namespace palpate::tissue

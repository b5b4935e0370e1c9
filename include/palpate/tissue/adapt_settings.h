// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/keys/fields.h"

namespace palpate::tissue {

/// How fine an organ's mesh becomes around tools.
struct AdaptSettings {
  double finest = 0.0;  ///< Edge length of the tetrahedra at a tool [m]; 0: the mesh never changes.
  double growth = 1.0;  ///< By which it is longer in a metre of distance from the tool.

  bool on() const { return finest > 0.0; }
};

void describe(keys::FieldVisitor& v, AdaptSettings& adapt);

}  // namespace palpate::tissue

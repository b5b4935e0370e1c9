// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/keys/fields.h"

namespace palpate::tissue {

/// Settings of mesh adaptation around tools.
struct AdaptSettings {
  double finest = 0.0;  ///< Edge length at a tool [m]; 0: no adaptation.
  double growth = 1.0;  ///< Growth of the edge length by distance from the tool [-].

  bool on() const { return finest > 0.0; }
};

void describe(keys::FieldVisitor& v, AdaptSettings& adapt);

}  // namespace palpate::tissue

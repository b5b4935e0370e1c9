// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/keys/fields.h"

namespace palpate::tissue {

/// Of an organ of model mass_spring: what its springs are, and how they go on.
struct SpringSettings {
  std::string scheme = "implicit";  ///< One of springSchemeNames().
  double step = 0.0;    ///< Longest explicit sub-step [s]; 0: nine tenths of what is stable.
  double region = 0.0;  ///< Only points so near a touched one at rest move [m]; 0: all.
  std::string constants = "volumes";  ///< volumes | fitted | file
  std::string file;                   ///< Of the network, as `palpate springs` writes it.
};

/// "implicit", by the scene's solver, and the explicit ones.
std::vector<std::string> springSchemeNames();

void describe(keys::FieldVisitor& v, SpringSettings& springs);

}  // namespace palpate::tissue

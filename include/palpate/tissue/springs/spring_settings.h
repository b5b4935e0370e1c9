// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/keys/fields.h"

namespace palpate::tissue {

/// How an organ of model mass_spring goes on.
struct SpringSettings {
  std::string integrator = "implicit";  ///< One of springIntegratorNames().
  double step = 0.0;    ///< Longest explicit sub-step [s]; 0: nine tenths of the stable one.
  double region = 0.0;  ///< Only points so near a touched one at rest move [m]; 0: all.
};

/// "implicit", by the scene's solver, and the explicit ones.
std::vector<std::string> springIntegratorNames();

void describe(keys::FieldVisitor& v, SpringSettings& springs);

}  // namespace palpate::tissue

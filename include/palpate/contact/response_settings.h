// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/contact/friction.h"

namespace palpate::contact {

/// Contact settings of a scene.
struct ResponseSettings {
  std::string model = "augmented_lagrangian";  ///< One of responseNames().
  double stiffness = 3.0e8;                    ///< Pressure per penetration [Pa/m].
  double smoothing = 1.0e-4;  ///< Width of the blend between no contact and linear [m].
  FrictionTable friction_with = {};
};

}  // namespace palpate::contact

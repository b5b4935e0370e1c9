// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/material/material.h"

namespace palpate::test {

// A whole law at F, as material/law.h has it for a law whose type is known.

double energyDensity(const material::Material& material, const Mat3& F);      ///< [J/m^3]
Mat3 firstPiolaKirchhoff(const material::Material& material, const Mat3& F);  ///< [Pa]
Mat9 tangent(const material::Material& material, const Mat3& F);              ///< [Pa]

}  // namespace palpate::test

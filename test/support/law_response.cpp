// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/law_response.h"

#include "palpate/material/law_list.h"

namespace palpate::test {

double energyDensity(const material::Material& material, const Mat3& F) {
  return visitLaw([&](const auto& law) { return energyDensity(law, F); }, material);
}

Mat3 firstPiolaKirchhoff(const material::Material& material, const Mat3& F) {
  return visitLaw([&](const auto& law) { return firstPiolaKirchhoff(law, F); }, material);
}

Mat9 tangent(const material::Material& material, const Mat3& F) {
  return visitLaw([&](const auto& law) { return tangent(law, F); }, material);
}

}  // namespace palpate::test

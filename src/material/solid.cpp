// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/material/solid.h"

#include <stdexcept>

#include "palpate/base/number.h"

namespace palpate::material {

void checkProny(const Material& law, const std::vector<PronyTerm>& prony) {
  if (prony.empty()) return;
  if (!isFrameIndifferent(law)) {
    throw std::invalid_argument("law " + lawName(law) +
                                " is for small rotations and cannot relax; use corotational");
  }
  double sum = 0.0;
  for (const PronyTerm& term : prony) {
    if (!(term.g > 0.0 && term.g < 1.0)) {
      throw std::invalid_argument("g = " + formatNumber(term.g) + ": must be in (0, 1)");
    }
    if (!(term.tau > 0.0) || term.tau > 1e12) {
      throw std::invalid_argument("tau = " + formatNumber(term.tau) + ": must be in (0, 1e12] s");
    }
    sum += term.g;
  }
  if (!(sum < 1.0)) {
    throw std::invalid_argument("sum of g = " + formatNumber(sum) +
                                ": must be < 1, or nothing is left after long");
  }
}

}  // namespace palpate::material

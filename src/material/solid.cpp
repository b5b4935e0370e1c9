// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/material/solid.h"

#include "palpate/base/number.h"

namespace palpate::material {

namespace {

void checkTerm(const PronyTerm& term, std::size_t index) {
  const auto refuse = [&](const char* name, double value, const char* rule) {
    PronyError error(name, formatNumber(value), rule);
    error.term = index;
    throw error;
  };
  if (!(term.g > 0.0 && term.g < 1.0)) refuse("g", term.g, "must be in (0, 1)");
  if (!(term.tau > 0.0) || term.tau > 1e12) refuse("tau", term.tau, "must be in (0, 1e12] s");
}

}  // namespace

void checkProny(const Material& law, const std::vector<PronyTerm>& prony) {
  if (prony.empty()) return;
  if (!isFrameIndifferent(law)) {
    throw PronyError(lawName(law), "is for small rotations and cannot relax; use corotational");
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < prony.size(); ++i) {
    checkTerm(prony[i], i);
    sum += prony[i].g;
  }
  if (!(sum < 1.0)) {
    throw PronyError("sum of g", formatNumber(sum), "must be < 1, or nothing is left after long");
  }
}

}  // namespace palpate::material

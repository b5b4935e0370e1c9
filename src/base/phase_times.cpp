// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/phase_times.h"

#include <chrono>

namespace palpate {

std::string_view toString(Phase phase) {
  switch (phase) {
    case Phase::kContact:
      return "contact";
    case Phase::kForces:
      return "forces";
    case Phase::kAssembly:
      return "assembly";
    case Phase::kLinearSolve:
      return "linear_solve";
    case Phase::kLineSearch:
      return "line_search";
    case Phase::kOther:
      return "other";
    case Phase::kHaptics:
      return "haptics";
    case Phase::kPublish:
      return "publish";
  }
  return "unknown";
}

double steadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace palpate

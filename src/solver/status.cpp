// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/status.h"

namespace palpate::solver {

std::string_view toString(SolveStatus status) {
  switch (status) {
    case SolveStatus::kConverged:
      return "converged";
    case SolveStatus::kInverted:
      return "inverted";
    case SolveStatus::kIterationLimit:
      return "iteration_limit";
    case SolveStatus::kDeadline:
      return "deadline";
    case SolveStatus::kLineSearchFailed:
      return "line_search_failed";
    case SolveStatus::kNotPositiveDefinite:
      return "not_positive_definite";
    case SolveStatus::kNonFinite:
      return "non_finite";
  }
  return "unknown";
}

}  // namespace palpate::solver

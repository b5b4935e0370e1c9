// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace palpate::solver {

/// How a solve ended, from best to worst. Not converging is an outcome of the physics, not a
/// program error: it is returned, never thrown, and the caller decides what the hand feels.
enum class SolveStatus {
  kConverged,
  kInverted,  ///< In balance, but the shape is none of a body: det F <= 0 somewhere.
  kIterationLimit,
  kDeadline,  ///< Ended early because it was asked to.
  kLineSearchFailed,
  kNotPositiveDefinite,
  kNonFinite
};

/// The forces are in balance, to the tolerance that was asked for.
inline bool balanced(SolveStatus status) { return status <= SolveStatus::kInverted; }

/// What a solve comes to whose smallest det F is `min_jacobian`.
inline SolveStatus judged(SolveStatus status, double min_jacobian) {
  return status == SolveStatus::kConverged && min_jacobian <= 0.0 ? SolveStatus::kInverted : status;
}

/// A state to go on from: it was reached by steps each of which made it better.
inline bool usable(SolveStatus status) { return status <= SolveStatus::kDeadline; }

std::string_view toString(SolveStatus status);

}  // namespace palpate::solver

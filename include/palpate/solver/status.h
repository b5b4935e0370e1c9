// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace palpate::solver {

/// How a solve ended, from best to worst. Not converging is an outcome of the physics, not a
/// program error: it is returned, never thrown, and the caller decides what the hand feels.
enum class SolveStatus {
  kConverged,
  kIterationLimit,
  kDeadline,  ///< Ended early because it was asked to.
  kLineSearchFailed,
  kNotPositiveDefinite,
  kNonFinite
};

/// A state to go on from: it was reached by steps each of which made it better.
inline bool usable(SolveStatus status) { return status <= SolveStatus::kDeadline; }

std::string_view toString(SolveStatus status);

}  // namespace palpate::solver

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace palpate::solver {

/// How a solve ended, from best to worst. Not converging is an outcome of the physics, not a
/// program error: it is returned, never thrown, and the caller decides what the hand feels.
enum class SolveStatus {
  kConverged,
  kIterationLimit,
  kLineSearchFailed,
  kNotPositiveDefinite,
  kNonFinite
};

std::string_view toString(SolveStatus status);

}  // namespace palpate::solver

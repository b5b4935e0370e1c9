// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace palpate::solver {

/// How fast this process multiplies matrices, and how fast its processor could.
struct BlasSpeed {
  double dgemm = 0.0;  ///< Of two 256 x 256 matrices by the BLAS that CHOLMOD calls [flop/s].
  double peak = 0.0;   ///< Of multiply-adds in registers, one thread [flop/s].

  bool known() const { return dgemm > 0.0 && peak > 0.0; }
};

/// Takes some ms. Unknown (zeros) on processors other than x86-64, or if the process has no BLAS.
BlasSpeed measureBlasSpeed();

/// A BLAS for this processor reaches 70 to 95 % of its peak; one that took it for an older model
/// reaches a quarter and less.
inline constexpr double kSlowBlas = 0.35;

/// What is likely wrong and what to set, in a sentence; "" for a BLAS that is fast enough or not
/// known. `coretype`: what OPENBLAS_CORETYPE was set to when the process began, null if nothing.
std::string blasWarning(const BlasSpeed& speed, const char* coretype);

}  // namespace palpate::solver

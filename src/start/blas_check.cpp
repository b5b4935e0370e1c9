// SPDX-License-Identifier: GPL-3.0-or-later
#include "blas_check.h"

#include <cstdlib>

#include "palpate/solver/blas_speed.h"

namespace palpate::start {

std::string blasWarning() {
  return solver::blasWarning(solver::measureBlasSpeed(), std::getenv("OPENBLAS_CORETYPE"));
}

}  // namespace palpate::start

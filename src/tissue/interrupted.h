// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/solver/interrupt.h"

namespace palpate::tissue {

/// Whether a step should end with the best state so far, see TissueModel::setInterrupt().
inline bool isInterrupted(const solver::Interrupt* interrupt) {
  return interrupt != nullptr && *interrupt && (*interrupt)();
}

}  // namespace palpate::tissue

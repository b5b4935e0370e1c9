// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/state_bytes.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Writes a cycle's result, without figures that depend on machine speed: times, factor waits.
void putStep(const TissueStep& step, StateWriter* out);
/// @throws std::invalid_argument for bytes that are cut off.
void getStep(StateReader* in, TissueStep* step);

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/sim/scene_load.h"

namespace palpate::sim {

/// What may be changed about a scene whose slowest cycles take longer than 1 / facts.rate, most
/// effective first.
std::vector<LoadAdvice> adviseOn(const SceneFacts& facts, const LoadFigures& figures);

}  // namespace palpate::sim

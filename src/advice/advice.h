// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/advice/scene_verdict.h"

namespace palpate::advice {

/// Changes to a scene whose slowest cycles take longer than 1 / rates.simulation, most effective
/// first.
std::vector<Advice> adviseOn(const SceneFacts& facts, const CycleCosts& figures);

}  // namespace palpate::advice

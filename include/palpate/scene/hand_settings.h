// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/haptics/wrench_filter.h"
#include "palpate/scene/scene.h"

namespace palpate::scene {

/// What stands between the simulation and the hand that holds this instrument of the scene.
haptics::WrenchFilterSettings filterSettings(const Scene& scene,
                                             const InstrumentConfig& instrument);

}  // namespace palpate::scene

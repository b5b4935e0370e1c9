// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/haptics/wrench_filter.h"
#include "palpate/scene/scene.h"

namespace palpate::scene {

/// Settings of the wrench filter between simulation and hand for this instrument.
haptics::WrenchFilterSettings filterSettings(const Scene& scene,
                                             const InstrumentConfig& instrument);

}  // namespace palpate::scene

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace palpate::tissue {

/// Tolerance of a stage that is not the last of a cycle, relative to that of the last [-].
constexpr double kStageTolerance = 100.0;
/// Most searches for contact candidates in a stage.
constexpr int kMaxSearches = 4;
/// Most augmentations in a step, without and with friction.
constexpr int kMaxAugmentations = 3;
constexpr int kMaxFrictionAugmentations = 6;

}  // namespace palpate::tissue

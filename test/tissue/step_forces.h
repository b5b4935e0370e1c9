// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/tissue/tissue_model.h"

namespace palpate::test {

/// Of the contacts on all tools [N], in world axes.
inline Vec3 onTool(const tissue::TissueStep& step) {
  Vec3 sum = Vec3::Zero();
  for (const tissue::TissueContact& c : step.contacts) sum += c.force_W;
  return sum;
}

/// Sum of all forces on the tissue [N]; zero if they cancel.
inline Vec3 imbalance(const tissue::TissueStep& step) {
  return step.support_force + step.gravity_force + step.inertia_force - onTool(step);
}

}  // namespace palpate::test

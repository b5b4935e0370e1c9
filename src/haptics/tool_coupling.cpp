// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/tool_coupling.h"

#include "limits.h"

namespace palpate::haptics {

Vec3 couplingForce(const CouplingSettings& settings, const Vec3& p_hand, const Vec3& p_proxy) {
  return clamped(settings.coupling_stiffness * (p_proxy - p_hand), settings.coupling_force);
}

}  // namespace palpate::haptics

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::haptics {

/// Coupling of a hand and its proxy.
struct CouplingSettings {
  double coupling_stiffness = 100.0;  ///< [N/m]
  double coupling_force = 2.0;        ///< Bound of the coupling force [N].
};

/// Force on the hand at `p_hand` from its proxy at `p_proxy`, world [m]: a spring, limited [N].
/// Zero where both coincide, as in all but the fastest motions.
Vec3 couplingForce(const CouplingSettings& settings, const Vec3& p_hand, const Vec3& p_proxy);

}  // namespace palpate::haptics

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::haptics {

/// Rotates a wrench about the control frame's origin from world axes to control frame axes.
inline Wrench bodyWrench(const Wrench& spatial, const Mat3& R_WC) {
  const Mat3 R_CW = R_WC.transpose();
  return {R_CW * spatial.force, R_CW * spatial.torque};
}

}  // namespace palpate::haptics

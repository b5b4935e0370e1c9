// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::haptics {

/// A wrench at the control frame's origin, expressed in world, in the axes of the control frame.
inline Wrench bodyWrench(const Wrench& spatial, const Mat3& R_WC) {
  const Mat3 R_CW = R_WC.transpose();
  return {R_CW * spatial.force, R_CW * spatial.torque};
}

}  // namespace palpate::haptics

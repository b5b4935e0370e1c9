// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::fem {

/// Mask of components, 3 x n: 1 free, 0 held.
using FreeMask = Eigen::Matrix3Xd;

/// A node held in one direction, for example by a spring.
struct HeldDirection {
  int node;
  Vec3 direction;  ///< Unit.
};

/// Names of rigid motions that neither held components nor `held` prevent ("translation along x,
/// rotation about z"); empty if there are none. A mixed motion is named by its largest component.
std::string freeRigidMotions(const Points& X, const FreeMask& free,
                             const std::vector<HeldDirection>& held = {});

}  // namespace palpate::fem

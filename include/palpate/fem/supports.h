// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::fem {

/// Which components of which nodes move freely: 1, or are held: 0. 3 x n, of a body at rest in X.
using FreeMask = Eigen::Matrix3Xd;

/// A node that something holds in one direction, such as a spring.
struct HeldDirection {
  int node;
  Vec3 direction;  ///< Unit.
};

/// Rigid motions that neither the held components nor what `held` names stop, in words
/// ("translation along x, rotation about z"); empty if the body is held. A motion that mixes
/// several is named by its largest part.
std::string freeRigidMotions(const Points& X, const FreeMask& free,
                             const std::vector<HeldDirection>& held = {});

}  // namespace palpate::fem

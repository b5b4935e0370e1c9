// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/base/types.h"

namespace palpate::springs {

/// A tensor of fourth order and three dimensions that is symmetric in all indices, by its 15
/// components, each times the root of how often it occurs: lengths are those of the tensor.
using FourthOrder = Eigen::Matrix<double, 15, 1>;

/// v v v v.
FourthOrder fourthPower(const Vec3& v);

/// d_ij d_kl + d_ik d_jl + d_il d_jk; its length is the root of 45.
FourthOrder isotropicFourth();

/// The parts of a tensor that turn among themselves: a multiple of isotropicFourth(), what a
/// traceless symmetric matrix makes, and the rest, which has no trace. Orthogonal to each other.
struct FourthOrderParts {
  FourthOrder isotropic, second, rest;
};
FourthOrderParts partsOf(const FourthOrder& tensor);

}  // namespace palpate::springs

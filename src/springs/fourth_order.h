// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/base/types.h"

namespace palpate::springs {

/// A fully symmetric tensor of fourth order in three dimensions, as its 15 components times the
/// square roots of their multiplicities, so norms agree.
using FourthOrder = Eigen::Matrix<double, 15, 1>;

/// The tensor v v v v.
FourthOrder fourthPower(const Vec3& v);

/// d_ij d_kl + d_ik d_jl + d_il d_jk, of norm sqrt(45).
FourthOrder isotropicFourth();

/// Orthogonal, rotation-invariant parts of a tensor: a multiple of isotropicFourth(), the part of a
/// traceless symmetric matrix, and a traceless rest.
struct FourthOrderParts {
  FourthOrder isotropic, second, rest;
};
FourthOrderParts partsOf(const FourthOrder& tensor);

}  // namespace palpate::springs

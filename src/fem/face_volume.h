// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/base/types.h"
#include "palpate/fem/stiffness.h"

namespace palpate::fem {

// The volume under faces, 3 x k or 6 x k, whose derivative is the integral of N_a dx/dr x dx/ds
// where they are closed or their rim is held [Bonet, Wood 2008, sec. 8.5.2 for the second one].

/// From a point of the faces [m^3].
double volumeUnder(const Points& x, const Eigen::MatrixXi& faces);
/// g += s times the first derivative, 3 x n.
void addVolumeGradient(const Points& x, const Eigen::MatrixXi& faces, double s, Points* g);
/// K += s times the symmetric part of the second one.
void addVolumeHessian(const Points& x, const Eigen::MatrixXi& faces, double s, Stiffness* K);

}  // namespace palpate::fem

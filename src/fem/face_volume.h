// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/base/types.h"
#include "palpate/fem/stiffness.h"

namespace palpate::fem {

// Volume under faces, 3 x k or 6 x k. Its derivative is the integral of N_a dx/dr x dx/ds if they
// are closed or their rim is held [Bonet, Wood 2008, sec. 8.5.2 for the second derivative].

/// Volume [m^3], measured from a point of the faces.
double volumeUnder(const Points& x, const Eigen::MatrixXi& faces);
/// Adds s times the first derivative to g, 3 x n.
void addVolumeGradient(const Points& x, const Eigen::MatrixXi& faces, double s, Points* g);
/// Adds s times the symmetric part of the second derivative to K.
void addVolumeHessian(const Points& x, const Eigen::MatrixXi& faces, double s, Stiffness* K);

}  // namespace palpate::fem

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::skin {

/// How a body becomes a plane one.
enum class Idealization {
  kPlaneStressPublished,  ///< Plane stress with E/(1 + nu^2), as [Triantafyllopoulos 2005, (2.21)].
  kPlaneStress,           ///< A thin sheet: E/(1 - nu^2).
  kPlaneStrain,           ///< No strain across the plane.
  kAxisymmetric           ///< Rings about x = 0: x is the radius.
};

/// "plane_stress_published", ...
std::string_view toString(Idealization idealization);
/// In the order of the enumeration.
std::vector<std::string> idealizationNames();
/// @throws std::invalid_argument for a name that toString() does not give.
Idealization idealizationOf(std::string_view name);

using Corners = Eigen::Matrix<double, 2, 3>;         ///< x, z of three nodes [m]
using TriangleStrain = Eigen::Matrix<double, 4, 6>;  ///< Strain by x, z of each node in turn [1/m]
using TriangleStiffness = Eigen::Matrix<double, 6, 6>;

/// Stress by strain (4 x 4) of components xx, zz, xz (twice the tensor's) and across the plane
/// [Pa]. The last is of rings only, and 0 otherwise.
Eigen::Matrix4d elasticityMatrix(Idealization idealization, double young_modulus,
                                 double poisson_ratio);

/// Half the cross product of two sides [m^2]: > 0 where corners go from x to z.
double signedArea(const Corners& corners);

/// Of a triangle of constant strain [Triantafyllopoulos 2005, (2.22)]; the hoop strain of a ring,
/// u/r, is that at its centroid.
TriangleStrain strainMatrix(const Corners& corners, Idealization idealization);

/// B^T D B times the volume (2.26) [N/m]: area times thickness [m], or 2 pi times the centroid's
/// radius times the area, which has no thickness.
TriangleStiffness triangleStiffness(const Corners& corners, const Eigen::Matrix4d& elasticity,
                                    Idealization idealization, double thickness);

}  // namespace palpate::skin

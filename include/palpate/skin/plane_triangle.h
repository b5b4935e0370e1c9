// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::skin {

/// Reduction of a body to a plane problem.
enum class Idealization {
  kPlaneStressPublished,  ///< Plane stress with E/(1 + nu^2) [Triantafyllopoulos 2005, (2.21)].
  kPlaneStress,           ///< A thin sheet: E/(1 - nu^2).
  kPlaneStrain,           ///< No strain normal to the plane.
  kAxisymmetric           ///< Rings about x = 0; x is the radius.
};

/// "plane_stress_published", ...
std::string_view toString(Idealization idealization);
/// In the order of the enumeration.
std::vector<std::string> idealizationNames();
/// @throws std::invalid_argument for an unknown name.
Idealization idealizationOf(std::string_view name);

using Corners = Eigen::Matrix<double, 2, 3>;         ///< x, z of three nodes [m]
using TriangleStrain = Eigen::Matrix<double, 4, 6>;  ///< Strain by x, z of each node [1/m]
using TriangleStiffness = Eigen::Matrix<double, 6, 6>;

/// Maps strain to stress (4 x 4): xx, zz, xz (twice the tensor's) and normal to the plane [Pa]. The
/// last is nonzero for rings only.
Eigen::Matrix4d elasticityMatrix(Idealization idealization, double young_modulus,
                                 double poisson_ratio);

/// Half the cross product of two sides [m^2]; > 0 for corners ordered from x to z.
double signedArea(const Corners& corners);

/// Constant-strain triangle [Triantafyllopoulos 2005, (2.22)]; the hoop strain u/r of a ring is
/// that at the centroid.
TriangleStrain strainMatrix(const Corners& corners, Idealization idealization);

/// B^T D B times the volume (2.26) [N/m]: area times `thickness` [m]; for rings 2 pi times the
/// centroid's radius times the area.
TriangleStiffness triangleStiffness(const Corners& corners, const Eigen::Matrix4d& elasticity,
                                    Idealization idealization, double thickness);

}  // namespace palpate::skin

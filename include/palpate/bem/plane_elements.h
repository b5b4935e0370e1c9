// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/LU>

namespace palpate::bem {

/// A plane elastic body of unit thickness.
struct PlaneSolid {
  double shear_modulus;  ///< [Pa]
  double poisson_ratio;  ///< As for plane strain; nu / (1 + nu) for plane stress.
};

/// @throws std::invalid_argument unless young_modulus > 0 [Pa] and -1 < poisson_ratio < 1/2.
PlaneSolid planeStrain(double young_modulus, double poisson_ratio);
PlaneSolid planeStress(double young_modulus, double poisson_ratio);

/// Boundary conditions of each element's two components: the displacement [m] where `held`, else
/// the traction [Pa].
struct PlaneConditions {
  Eigen::Array<bool, 2, Eigen::Dynamic> held;
  Eigen::Matrix2Xd value;

  explicit PlaneConditions(Eigen::Index num_elements)
      : held(Eigen::Array<bool, 2, Eigen::Dynamic>::Constant(2, num_elements, false)),
        value(Eigen::Matrix2Xd::Zero(2, num_elements)) {}
};

/// Displacement [m] and traction [Pa] of each element.
struct PlaneSolution {
  Eigen::Matrix2Xd displacement, traction;
};

/// Plane elastostatics by straight boundary elements with constant displacement and traction,
/// collocated at their midpoints [Brebbia, Dominguez 1992],
///
///   1/2 u(p) + int T u = int U t,   H u = G t,
///   U_ij = 1/(8 pi mu (1 - nu)) [(3 - 4 nu) ln(D/r) d_ij + r,i r,j]
///   T_ij = -1/(4 pi (1 - nu) r) [dr/dn ((1 - 2 nu) d_ij + 2 r,i r,j)
///                                - (1 - 2 nu) (r,i n_j - r,j n_i)]
///
/// with Kelvin's solution; D, the body's size, makes results independent of the unit. Element
/// integrals have ten Gauss points; for p on the element (half length R, half vector l) that of U
/// is R/(4 pi mu (1 - nu)) [(3 - 4 nu) (1 - ln(R/D)) I + l l^T/R^2], that of T is 0.
class PlaneElements {
 public:
  /// `points` 2 x n [m]; element k runs from point ends(0, k) to ends(1, k), with the body on the
  /// left.
  /// @throws std::invalid_argument for an element of zero length or an unknown point.
  PlaneElements(const Eigen::Matrix2Xd& points, const Eigen::Matrix2Xi& ends,
                const PlaneSolid& solid);

  Eigen::Index size() const { return middles_.cols(); }
  const Eigen::Matrix2Xd& middles() const { return middles_; }  ///< 2 x m [m]
  const Eigen::Matrix2Xd& normals() const { return normals_; }  ///< Outward, 2 x m.
  const Eigen::VectorXd& lengths() const { return lengths_; }   ///< [m]
  /// H for displacements, 2 m x 2 m, dense [-].
  const Eigen::MatrixXd& displacementMatrix() const { return H_; }
  /// G for tractions, 2 m x 2 m, dense [m/Pa].
  const Eigen::MatrixXd& tractionMatrix() const { return G_; }

  /// @throws std::invalid_argument if sizes differ or the conditions leave a rigid motion.
  PlaneSolution solve(const PlaneConditions& conditions) const;
  /// u = int U t - int T u at an inner point, at least about an element's length from it [m].
  Eigen::Vector2d displacement(const Eigen::Vector2d& inside, const PlaneSolution& solution) const;

 private:
  void integrate(const Eigen::Vector2d& p, Eigen::Index element, Eigen::Matrix2d* U,
                 Eigen::Matrix2d* T) const;
  Eigen::Matrix2d ownU(Eigen::Index element) const;

  PlaneSolid solid_;
  double size_;  // D [m]
  Eigen::Matrix2Xd middles_, halves_, normals_;
  Eigen::VectorXd lengths_;
  Eigen::MatrixXd H_, G_;
};

}  // namespace palpate::bem

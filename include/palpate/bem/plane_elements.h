// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/LU>

namespace palpate::bem {

/// An elastic body of unit thickness whose points stay in its plane.
struct PlaneSolid {
  double shear_modulus;  ///< [Pa]
  double poisson_ratio;  ///< As plane strain has it; for plane stress nu / (1 + nu).
};

/// @throws std::invalid_argument unless young_modulus > 0 [Pa] and -1 < poisson_ratio < 1/2.
PlaneSolid planeStrain(double young_modulus, double poisson_ratio);
PlaneSolid planeStress(double young_modulus, double poisson_ratio);

/// What is known of each element's two components: the displacement [m] where `held`, else the
/// traction [Pa].
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

/// Plane elastostatics by boundary elements: straight, displacement and traction constant on each,
/// collocated at their middles [Brebbia, Dominguez 1992],
///
///   1/2 u(p) + int T u = int U t,   H u = G t,
///   U_ij = 1/(8 pi mu (1 - nu)) [(3 - 4 nu) ln(D/r) d_ij + r,i r,j]
///   T_ij = -1/(4 pi (1 - nu) r) [dr/dn ((1 - 2 nu) d_ij + 2 r,i r,j)
///                                - (1 - 2 nu) (r,i n_j - r,j n_i)]
///
/// by Kelvin's solution, D the body's size, so that no unit of length is a special one. Element
/// integrals have ten Gauss points; that of U over the element p is on is (half length R, half
/// vector l) R/(4 pi mu (1 - nu)) [(3 - 4 nu) (1 - ln(R/D)) I + l l^T/R^2], that of T 0.
class PlaneElements {
 public:
  /// `points` 2 x n [m]; element k goes from point ends(0, k) to ends(1, k) with the body on its
  /// left.
  /// @throws std::invalid_argument for an element without length or a point that there is not.
  PlaneElements(const Eigen::Matrix2Xd& points, const Eigen::Matrix2Xi& ends,
                const PlaneSolid& solid);

  Eigen::Index size() const { return middles_.cols(); }
  const Eigen::Matrix2Xd& middles() const { return middles_; }  ///< 2 x m [m]
  const Eigen::Matrix2Xd& normals() const { return normals_; }  ///< Outward, 2 x m.
  const Eigen::VectorXd& lengths() const { return lengths_; }   ///< [m]
  /// H, of displacements, 2 m x 2 m, dense, without a unit.
  const Eigen::MatrixXd& displacementMatrix() const { return H_; }
  /// G, of tractions, likewise [m/Pa].
  const Eigen::MatrixXd& tractionMatrix() const { return G_; }

  /// @throws std::invalid_argument if the sizes differ or the conditions leave the body a motion.
  PlaneSolution solve(const PlaneConditions& conditions) const;
  /// u = int U t - int T u at a point inside, no nearer to an element than about its length [m].
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

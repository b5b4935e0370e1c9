// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::springs {

/// What a spring stands for: to the neighbour, past it, across a rectangle; in a solid the sides
/// and diagonals of cells, and the edges of tetrahedra.
enum class SpringKind { kStructural, kFlexion, kShear, kEdge, kFaceDiagonal, kBodyDiagonal };

/// "structural", "flexion", "shear", "edge", "face_diagonal", "body_diagonal".
std::string_view toString(SpringKind kind);
std::optional<SpringKind> springKindOf(std::string_view name);
std::vector<std::string> springKindNames();

/// A linear spring between two points, with preload: at the distance u it pulls them together by
///
///     F(u) = preload + stiffness (u - length)
///
/// [Wang 2005, chapter 5]. A damper beside it pulls by damping times the relative velocity [(2.2)].
struct Spring {
  int a;             ///< Its ends, as columns of the network's points.
  int b;             ///< Another point than a.
  double stiffness;  ///< [N/m], >= 0
  double preload;    ///< Force at the distance `length` [N]; > 0 pulls.
  double damping;    ///< [N s/m], >= 0
  double length;  ///< Distance at which the force is the preload [m], > 0; not the force-free one.
  SpringKind kind;
};

/// Point masses and what connects them.
struct SpringNetwork {
  Points points;  ///< Where every spring is as long as its `length`, 3 x n [m].
  std::vector<Spring> springs;
  Eigen::VectorXd masses;  ///< One a point [kg].
};

/// Energy of a spring at the distance u [m], 0 at `length` [J]; its first and second derivative are
/// springForce() [N] and the stiffness.
double springEnergy(const Spring& spring, double u);
double springForce(const Spring& spring, double u);

/// Force on end a where end b is d = x_b - x_a away [N]; that on b is the opposite one. Zero where
/// the ends meet, for there is no direction.
Vec3 springForceOnA(const Spring& spring, const Vec3& d);

/// Second derivative of the energy by d, 3 x 3 [N/m]: stiffness along d, F(u)/u across.
Mat3 springTangent(const Spring& spring, const Vec3& d);

/// Sum over all springs [J], with the points at x (3 x n).
double networkEnergy(const SpringNetwork& network, const Points& x);
/// Forces of the springs on the points, 3 x n [N].
Points networkForces(const SpringNetwork& network, const Points& x);

/// @throws std::invalid_argument naming the first spring or point, counted from 0, that cannot be:
/// an end that there is not, equal ends, a length or mass that is not > 0, a negative stiffness or
/// damping, a number that is not finite.
void checkNetwork(const SpringNetwork& network);

}  // namespace palpate::springs

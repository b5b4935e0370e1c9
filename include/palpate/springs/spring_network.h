// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::springs {

/// Role of a spring: to the neighbour, to the second neighbour, across a rectangle; in solids the
/// edges and diagonals of cells, and the edges of tetrahedra.
enum class SpringKind { kStructural, kFlexion, kShear, kEdge, kFaceDiagonal, kBodyDiagonal };

/// "structural", "flexion", "shear", "edge", "face_diagonal", "body_diagonal".
std::string_view toString(SpringKind kind);
std::optional<SpringKind> springKindOf(std::string_view name);
std::vector<std::string> springKindNames();

/// A linear spring between two points, with preload. At the distance u it pulls them together by
///
///     F(u) = preload + stiffness (u - length)
///
/// [Wang 2005, chapter 5]. A parallel damper pulls by damping times relative velocity [(2.2)].
struct Spring {
  int a;             ///< First end, as a column of the network's points.
  int b;             ///< Second end, another point.
  double stiffness;  ///< [N/m], >= 0
  double preload;    ///< Force at the distance `length` [N]; > 0 pulls.
  double damping;    ///< [N s/m], >= 0
  double length;     ///< Distance with the force `preload` [m], > 0.
  SpringKind kind;
};

/// Point masses with springs.
struct SpringNetwork {
  Points points;  ///< Positions at which all springs have their `length`, 3 x n [m].
  std::vector<Spring> springs;
  Eigen::VectorXd masses;  ///< One per point [kg].
};

/// Energy of a spring at the distance u [m], 0 at `length` [J]. Its derivatives are springForce()
/// [N] and the stiffness.
double springEnergy(const Spring& spring, double u);
double springForce(const Spring& spring, double u);

/// Force on end a with end b at d = x_b - x_a; that on b is opposite. Zero for coincident ends,
/// which have no direction.
Vec3 springForceOnA(const Spring& spring, const Vec3& d);

/// Second derivative of the energy by d, 3 x 3 [N/m]: stiffness along d, F(u)/u across d.
Mat3 springTangent(const Spring& spring, const Vec3& d);

/// Sum over all springs [J], with the points at x (3 x n).
double networkEnergy(const SpringNetwork& network, const Points& x);
/// Forces of the springs on the points, 3 x n [N].
Points networkForces(const SpringNetwork& network, const Points& x);

/// @throws std::invalid_argument naming the first wrong spring or point, counted from 0: an unknown
/// end, equal ends, a length or mass not > 0, negative stiffness or damping, a non-finite number.
void checkNetwork(const SpringNetwork& network);

}  // namespace palpate::springs

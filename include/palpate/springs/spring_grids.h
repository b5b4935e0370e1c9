// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/springs/spring_network.h"
#include "palpate/springs/structured_springs.h"

namespace palpate::springs {

/// Position of a node in a regular sheet mesh, in steps along its two axes.
using GridNode = Eigen::Vector2i;

/// Masses on the x axis from 0, `spacing` apart [m]; `line_density` [kg/m].
/// @throws std::invalid_argument for fewer than 2 nodes, and as requirePositive(); so do all below.
SpringNetwork lineNetwork(const LineSprings& springs, double spacing, int nodes,
                          double line_density);

/// A sheet of squares in the plane z = 0 with node (i, j) at (i U, j U). Springs connect existing
/// nodes; a flexion spring needs its middle node. Masses are of whole squares; `areal_density`
/// [kg/m^2].
/// @throws std::invalid_argument also for a repeated node, or one without square.
SpringNetwork rectangleNetwork(const RectangleSprings& springs, double spacing,
                               const std::vector<GridNode>& nodes, double areal_density);

/// The same of equilateral triangles: node (i, j) is at ((i + j/2) U, sqrt(3)/2 j U).
SpringNetwork triangleNetwork(const TriangleSprings& springs, double spacing,
                              const std::vector<GridNode>& nodes, double areal_density);

/// columns x rows nodes from (0, 0), row after row.
std::vector<GridNode> rectangleNodes(int columns, int rows);
/// As rectangleNodes(), for triangles; every second row is shifted right by half a spacing.
std::vector<GridNode> triangleNodes(int columns, int rows);

/// `cells` cubes along each axis from the origin; `density` [kg/m^3]. Each cube contributes 1/4 of
/// the stiffness of its edges, 1/2 of its face diagonals and all of its body diagonals, so boundary
/// springs have the stiffness of their cubes [Wang 2005, 7.3]. Springs with zero stiffness are left
/// out.
SpringNetwork cubeNetwork(const CubeSprings& springs, double edge, const Eigen::Vector3i& cells,
                          double density);

}  // namespace palpate::springs

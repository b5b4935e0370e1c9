// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/springs/spring_network.h"
#include "palpate/springs/structured_springs.h"

namespace palpate::springs {

/// Where a point is in a regular mesh of a sheet, in steps along its two axes.
using GridNode = Eigen::Vector2i;

/// Masses on the x axis from 0 on, `spacing` apart [m]; `line_density` [kg/m].
/// @throws std::invalid_argument for fewer than 2 nodes, and as requirePositive(); so do the next.
SpringNetwork lineNetwork(const LineSprings& springs, double spacing, int nodes,
                          double line_density);

/// A sheet of squares in the plane z = 0: node (i, j) is at (i U, j U). Springs connect what there
/// is; a flexion spring needs the node that it passes. Masses of whole squares; `areal_density`
/// [kg/m^2].
/// @throws std::invalid_argument also for a node that is listed twice, or is in no square.
SpringNetwork rectangleNetwork(const RectangleSprings& springs, double spacing,
                               const std::vector<GridNode>& nodes, double areal_density);

/// The same of equilateral triangles: node (i, j) is at ((i + j/2) U, sqrt(3)/2 j U).
SpringNetwork triangleNetwork(const TriangleSprings& springs, double spacing,
                              const std::vector<GridNode>& nodes, double areal_density);

/// columns x rows nodes from (0, 0) on, row after row.
std::vector<GridNode> rectangleNodes(int columns, int rows);
/// The same of triangles; every second row is half a spacing to the right.
std::vector<GridNode> triangleNodes(int columns, int rows);

/// `cells` cubes along each axis from the origin on; `density` [kg/m^3]. Every cube brings 1/4 of
/// its edges', 1/2 of its face diagonals' and all of its body diagonals' stiffness, so that edges
/// and faces at the boundary are as stiff as the cubes that share them [Wang 2005, 7.3]. No spring
/// has the stiffness 0.
SpringNetwork cubeNetwork(const CubeSprings& springs, double edge, const Eigen::Vector3i& cells,
                          double density);

}  // namespace palpate::springs

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/springs/spring_network.h"

namespace palpate::springs {

/// What an irregular sheet of triangles consists of.
struct SheetCounts {
  int triangles;          ///< N_t
  int vertices;           ///< N_v
  int boundary_vertices;  ///< N_b
  int valence_3;          ///< N_3: inner vertices of three triangles,
  int valence_4;          ///< N_4: of four.
  int springs;            ///< N_s

  /// 3 N_t - 3 N_3 - 2 N_4 [Wang 2005, (6.100)].
  int expectedSprings() const { return 3 * triangles - 3 * valence_3 - 2 * valence_4; }
};

/// Where a sheet of triangles has springs, and how many.
struct SheetTopology {
  std::vector<Spring> springs;  ///< With lengths and kinds, and zeros else.
  SheetCounts counts;
};

/// A structural spring along every edge, and a flexion spring between the two corners opposite to
/// every inner edge, unless there is a spring already: of the four around a vertex of valence 4 two
/// are left, of the three around one of valence 3 none [Wang 2005, 6.3].
///
/// @throws std::invalid_argument naming the triangle that is collapsed, has a point that there is
/// not, turns the other way than a neighbour, or is the third at an edge, or the point of no
/// triangle, counted from 0.
SheetTopology sheetTopology(const Points& points, const Eigen::Matrix3Xi& triangles);

}  // namespace palpate::springs

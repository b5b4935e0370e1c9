// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/springs/spring_network.h"

namespace palpate::springs {

/// Counts of an irregular sheet of triangles.
struct SheetCounts {
  int triangles;          ///< N_t
  int vertices;           ///< N_v
  int boundary_vertices;  ///< N_b
  int valence_3;          ///< N_3: inner vertices with three triangles
  int valence_4;          ///< N_4: inner vertices with four triangles
  int springs;            ///< N_s

  /// 3 N_t - 3 N_3 - 2 N_4 [Wang 2005, (6.100)].
  int expectedSprings() const { return 3 * triangles - 3 * valence_3 - 2 * valence_4; }
};

/// Springs of a sheet of triangles, with counts.
struct SheetTopology {
  std::vector<Spring> springs;  ///< With lengths and kinds; other values are zero.
  SheetCounts counts;
};

/// A structural spring along every edge, and a flexion spring between the two corners opposite
/// every inner edge, except where a spring exists: two of four remain around a vertex of valence 4,
/// none of three around one of valence 3 [Wang 2005, 6.3].
///
/// @throws std::invalid_argument naming, counted from 0, a collapsed triangle, one with an unknown
/// point, inconsistent orientation or a third triangle at an edge, or a point without triangle.
SheetTopology sheetTopology(const Points& points, const Eigen::Matrix3Xi& triangles);

}  // namespace palpate::springs

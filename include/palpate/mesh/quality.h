// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/mesh/surface_mesh.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::mesh {

/// How good a mesh is. A regular tetrahedron has dihedral angles of 70.5 degrees and a
/// radius-edge ratio of 0.61.
struct TetQuality {
  double min_dihedral_deg = 0.0;         ///< Least angle between two faces of a tetrahedron.
  double median_dihedral_deg = 0.0;      ///< Median over the tetrahedra of their least angle.
  double worst_radius_edge_ratio = 0.0;  ///< Largest circumradius by shortest edge; inf if flat.
  double mean_edge_length = 0.0;         ///< [m], each edge once.
  double volume = 0.0;                   ///< [m^3]
  double volume_error = 0.0;             ///< (volume - reference's) / reference's; 0 without one.
};

/// Corner nodes only. `reference`: the closed surface that was meshed, or null. All zero for a
/// mesh without tetrahedra.
TetQuality measureQuality(const TetMesh& mesh, const SurfaceMesh* reference = nullptr);

}  // namespace palpate::mesh

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/mesh/tet_mesh.h"

namespace palpate::formats {

/// Reads tetrahedra, by the file's extension (upper or lower case):
///
///     .msh   Gmsh 1; 2.x text and binary; 4.1 text and binary
///     .vtk   VTK legacy UNSTRUCTURED_GRID, text and binary, versions 1 to 5.1
///     .vtu   VTK XML: text, base64, appended raw and base64, zlib
///     .mesh  Medit, text
///
/// 4-node and 10-node tetrahedra; the latter fill `midnodes`. Cells of lower dimension are ignored,
/// other volume cells refused. `region` comes from Gmsh's physical tag (else the elementary tag),
/// Medit's reference, or VTK cell data `region` or `gmsh:physical`.
/// `cell_data` holds all VTK cell data of one or three components.
/// Unused points are dropped. If all tetrahedra have negative volume, the file has the opposite
/// corner order, and all are reversed.
///
/// @throws InputError naming the line (or byte, or array): missing, empty or truncated file,
/// unknown extension or version, index out of range, non-finite coordinate, 4-node and 10-node
/// tetrahedra mixed, the same tetrahedron twice, no tetrahedron at all, and as checkTets().
mesh::TetMesh readTetMesh(const std::string& file);

/// @throws InputError naming `file`, with the numbers of inverted (negative volume) and degenerate
/// tetrahedra (|V| <= 1e-12 of the longest edge cubed), and the first of each, counted from 1.
void checkTets(const mesh::TetMesh& mesh, const std::string& file);

}  // namespace palpate::formats

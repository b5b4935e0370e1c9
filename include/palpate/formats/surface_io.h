// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::formats {

/// Reads a surface, by the file's extension (upper or lower case):
///
///     .obj  Wavefront; faces `v`, `v/vt`, `v//vn`, `v/vt/vn`, negative indices
///     .off  OFF, COFF, NOFF, ... in text; what follows x y z on a line is ignored
///     .stl  text or binary, told apart by content; bitwise equal points are merged
///     .ply  text, binary little and big endian
///     .wrl  VRML 2.0 (97): every IndexedFaceSet, with the Transforms above it and DEF/USE
///
/// Polygons are cut into fans from their first corner. Points that no triangle uses are dropped.
/// Coordinates are in the file's unit; nothing is checked but the file itself.
///
/// @throws InputError naming the line (or byte): missing, empty or truncated file, unknown
/// extension, index out of range, non-finite coordinate, face with fewer than 3 corners, no
/// triangle at all.
mesh::SurfaceMesh readSurface(const std::string& file);

/// Writes .off or .obj with 17 significant digits: the same surface gives the same bytes, and
/// reading gives back the same coordinates bit for bit. The file appears whole or not at all.
///
/// @throws InputError for another extension, or if the file cannot be written.
void writeSurface(const std::string& file, const mesh::SurfaceMesh& surface);

}  // namespace palpate::formats

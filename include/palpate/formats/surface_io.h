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
/// Polygons are split into fans from their first corner. Unused points are dropped. Coordinates are
/// in the file's unit; only the file's syntax is checked.
///
/// @throws InputError naming the line (or byte): missing, empty or truncated file, unknown
/// extension, index out of range, non-finite coordinate, face with fewer than 3 corners, no
/// triangle at all.
mesh::SurfaceMesh readSurface(const std::string& file);

/// Writes .off or .obj with 17 significant digits, atomically. Equal surfaces give equal bytes;
/// coordinates are read back exactly.
///
/// @throws InputError for another extension, or if the file cannot be written.
void writeSurface(const std::string& file, const mesh::SurfaceMesh& surface);

}  // namespace palpate::formats

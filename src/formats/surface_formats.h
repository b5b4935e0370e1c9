// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::formats {

/// Reads `bytes` by the reader for the extension of `file`, as readSurface() does.
mesh::SurfaceMesh parseSurface(const std::string& file, std::string_view bytes);

// One reader per format: `bytes` is the content of `file`, whose name is for messages only.
mesh::SurfaceMesh readObj(const std::string& file, std::string_view bytes);
mesh::SurfaceMesh readOff(const std::string& file, std::string_view bytes);
mesh::SurfaceMesh readPly(const std::string& file, std::string_view bytes);
mesh::SurfaceMesh readStl(const std::string& file, std::string_view bytes);
mesh::SurfaceMesh readWrl(const std::string& file, std::string_view bytes);

}  // namespace palpate::formats

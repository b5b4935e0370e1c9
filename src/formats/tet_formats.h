// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "palpate/mesh/tet_mesh.h"

namespace palpate::formats {

/// Reads `bytes` by the reader for the extension of `file`, as readTetMesh() does.
mesh::TetMesh parseTetMesh(const std::string& file, std::string_view bytes);

// One reader per format: `bytes` is the content of `file`, whose name is for messages only.
mesh::TetMesh readMedit(const std::string& file, std::string_view bytes);
mesh::TetMesh readMsh(const std::string& file, std::string_view bytes);
mesh::TetMesh readVtk(const std::string& file, std::string_view bytes);
mesh::TetMesh readVtu(const std::string& file, std::string_view bytes);

}  // namespace palpate::formats

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "palpate/mesh/tet_mesh.h"

namespace palpate::formats {

/// The reader that the extension of `file` names, on `bytes`; what readTetMesh() does with a file's
/// content.
mesh::TetMesh parseTetMesh(const std::string& file, std::string_view bytes);

// One reader a format: `bytes` is the content of `file`, whose name is for messages only.
mesh::TetMesh readMedit(const std::string& file, std::string_view bytes);
mesh::TetMesh readMsh(const std::string& file, std::string_view bytes);
mesh::TetMesh readVtk(const std::string& file, std::string_view bytes);
mesh::TetMesh readVtu(const std::string& file, std::string_view bytes);

}  // namespace palpate::formats

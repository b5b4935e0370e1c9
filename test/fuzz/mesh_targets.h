// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace palpate::fuzz {

// Files of meshes, one function a format: what parseSurface() or parseTetMesh() makes of the bytes.
void readObj(std::string_view bytes);
void readOff(std::string_view bytes);
void readStl(std::string_view bytes);
void readPly(std::string_view bytes);
void readWrl(std::string_view bytes);
void readMsh(std::string_view bytes);
void readVtk(std::string_view bytes);
void readVtu(std::string_view bytes);
void readMesh(std::string_view bytes);

/// What follows where a surface was read: it is looked at, mended, and made a tool's shape. The
/// bytes are an .off file.
void repairSurface(std::string_view bytes);

}  // namespace palpate::fuzz

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/torture/torture_scene.h"

namespace palpate::torture {

/// Writes a tool's URDF and mesh, if any. @returns its lines of the scene file.
std::string writeTool(const TortureTool& tool, const std::string& folder);

}  // namespace palpate::torture

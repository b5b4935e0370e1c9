// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/RecordedFile.h"
#include "palpate/scene/scene.h"

namespace palpate::node {

/// The scene's file and all that it names, with what they hold: whatever text of its keys is the
/// name of a file, all files of the folder of a database, and the meshes of robot descriptions.
std::vector<palpate::RecordedFile> sceneFiles(const scene::Scene& scene);

}  // namespace palpate::node

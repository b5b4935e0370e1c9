// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/sim/simulator.h"
#include "palpate/torture/torture_scene.h"

namespace palpate::torture {

/// Paths of a scene's files.
struct SceneFiles {
  std::string scene, trajectory;
  std::string state;  ///< Initial state of a scene that does not begin at rest; else empty.

  /// The command `palpate replay ...` that replays the scene.
  std::string command() const;
};

/// Writes scene.yaml and its files into an existing folder.
/// @throws InputError
SceneFiles writeScene(const TortureScene& scene, const std::string& folder);

/// Moves a simulator, after its first row, to the scene's initial state, and writes that state.
/// @throws InputError
void writeStart(const TortureScene& scene, const SceneFiles& files, sim::Simulator* simulator);

}  // namespace palpate::torture

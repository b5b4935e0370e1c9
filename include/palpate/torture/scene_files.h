// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/sim/simulator.h"
#include "palpate/torture/torture_scene.h"

namespace palpate::torture {

/// Where the files of a scene are.
struct SceneFiles {
  std::string scene, trajectory;
  std::string state;  ///< Of what does not begin at rest, else empty.

  /// `palpate replay ...`, which plays just this.
  std::string command() const;
};

/// Writes a scene into a folder, which must be there: scene.yaml, and what it names.
/// @throws InputError
SceneFiles writeScene(const TortureScene& scene, const std::string& folder);

/// Brings a simulator of the scene, whose first row was stepped, to where the scene begins, and
/// writes that state.
/// @throws InputError
void writeStart(const TortureScene& scene, const SceneFiles& files, sim::Simulator* simulator);

}  // namespace palpate::torture

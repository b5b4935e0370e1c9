// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "palpate/sim/simulator.h"

namespace palpate::fuzz {

/// A block of few tetrahedra under a ball on a joint "z" along z. `organ` are further lines of the
/// organ, `rest` of the instruments and of the scene.
std::unique_ptr<sim::Simulator> makeBlock(const std::string& organ, const std::string& rest);

/// Small scenes of the tissue models and methods, each with a tool that touches: what there is that
/// remembers something.
int numStateScenes();
/// Of one of them, after some cycles.
sim::SimulatorState stateOf(int scene);
/// Restores a payload in one of them, and goes on by two cycles.
/// @throws InputError where it is refused; then the simulator is as it was. Fault where what
/// follows is not finite.
void restoreInto(int scene, const std::string& payload);

}  // namespace palpate::fuzz

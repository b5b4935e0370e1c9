// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/sim/simulator.h"

namespace palpate::io {

/// Writes a simulator's state in a way that a reader never sees half a file: lines for the eye,
/// then the bytes of the state,
///
///     palpate state 3
///     scene: liver palpation
///     time: 12.5 s
///     organs: liver; model: fem; state: fem implicit_pcg backward_euler anp penalty, 1020 points
///     payload: 123456 bytes, crc32 0123abcd
///
/// with a checksum of all that stands in the file beside it.
/// @throws InputError if it cannot be written.
void writeState(const std::string& file, const sim::SimulatorState& state);

/// Reads what writeState() wrote.
/// @throws InputError: missing, of another format, cut off or changed.
sim::SimulatorState readState(const std::string& file);

/// The simulator goes on from a state file.
/// @throws InputError as readState(), or naming what the state is of if that is not this scene.
void restoreState(const std::string& file, sim::Simulator* simulator);

}  // namespace palpate::io

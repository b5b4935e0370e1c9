// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/sim/simulator.h"

namespace palpate::io {

/// Writes a simulator's state atomically: a readable header, then the bytes of the state,
///
///     palpate state 3
///     scene: liver palpation
///     time: 12.5 s
///     organs: liver; model: fem; state: fem implicit_pcg backward_euler anp penalty, 1020 points
///     payload: 123456 bytes, crc32 0123abcd
///
/// with a checksum of the rest of the file.
/// @throws InputError if it cannot be written.
void writeState(const std::string& file, const sim::SimulatorState& state);

/// Reads a file of writeState().
/// @throws InputError: missing, another format, truncated or changed.
sim::SimulatorState readState(const std::string& file);

/// Restores a simulator from a state file.
/// @throws InputError as readState(), or for the state of another scene; the simulator is then
/// unchanged.
void restoreState(const std::string& file, sim::Simulator* simulator);

}  // namespace palpate::io

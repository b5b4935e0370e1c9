// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/sim/simulator.h"

namespace palpate::io {

/// Writes a simulator's state as text, in a way that a reader never sees half a file:
///
///     # palpate state 1
///     # time = 12.5
///     organ,node,x,y,z,vx,vy,vz
///     liver,0,0.01,...                       positions [m] and velocities [m/s], world
///
/// Numbers have as many digits as bring back the same bits. `organs`: one name an organ.
/// @throws std::runtime_error naming the file if it cannot be written, or if a number is not
/// finite.
void writeState(const std::string& file, const std::vector<std::string>& organs,
                const sim::SimulatorState& state);

/// Reads what writeState() wrote. `organs` must be the names in the file, in that order.
/// @throws InputError: missing, another format, truncated, a number that is not finite, other
/// organs.
sim::SimulatorState readState(const std::string& file, const std::vector<std::string>& organs);

}  // namespace palpate::io

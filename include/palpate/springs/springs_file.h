// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/springs/spring_network.h"

namespace palpate::springs {

/// Writes a network as two tables of comma-separated values in one file, in SI units:
///
///     point,x,y,z,mass
///     0,0.01,0,0,0.002
///     ...
///     a,b,kind,stiffness,preload,length,damping
///     0,1,structural,120,0.5,0.01,0
///     ...
///
/// Points are numbered from 0 on, kinds are springKindNames(). The same network gives the same
/// bytes, and reading gives back the same bits. The file appears whole or not at all.
///
/// @throws InputError if the file cannot be written; std::invalid_argument, see checkNetwork().
void writeSprings(const std::string& file, const SpringNetwork& network);

/// Reads what writeSprings() writes. Lines that begin with # and empty ones are skipped; blanks
/// around values do not count.
///
/// @throws InputError naming line, column, value and what is allowed, of all that is wrong: no or a
/// wrong first row of a table, a row of another length, points that are not numbered in order, no
/// number, a mass or length that is not > 0, a negative stiffness or damping, an end that there is
/// not, equal ends, an unknown kind.
SpringNetwork readSprings(const std::string& file);

}  // namespace palpate::springs

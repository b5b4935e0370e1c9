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
/// Points are numbered from 0; kinds are springKindNames(). Equal networks give equal bytes;
/// numbers are read back exactly. Writes atomically.
///
/// @throws InputError if the file cannot be written; std::invalid_argument, see checkNetwork().
void writeSprings(const std::string& file, const SpringNetwork& network);

/// Reads the files of writeSprings(). Empty lines, lines beginning with # and blanks around values
/// are ignored.
///
/// @throws InputError with line, column, value and allowed values of all errors: a missing or wrong
/// first row of a table, a row of another length, points not numbered in order, no number, a mass
/// or length not > 0, negative stiffness or damping, unknown or equal ends, an unknown kind.
SpringNetwork readSprings(const std::string& file);

}  // namespace palpate::springs

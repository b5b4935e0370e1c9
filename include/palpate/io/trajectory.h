// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/formats/trajectory.h"

namespace palpate::io {

/// Writes a file that formats::readTrajectory() reads back exactly.
/// @throws InputError if the file cannot be written.
void writeTrajectory(const std::string& file, const formats::Trajectory& trajectory);

}  // namespace palpate::io

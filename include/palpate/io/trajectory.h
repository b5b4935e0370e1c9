// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/formats/trajectory.h"

namespace palpate::io {

/// Writes numbers so that formats::readTrajectory() gives the same bits.
/// @throws InputError if the file cannot be written to its end.
void writeTrajectory(const std::string& file, const formats::Trajectory& trajectory);

}  // namespace palpate::io

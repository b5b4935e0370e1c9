// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/formats/trajectory.h"

namespace palpate::io {

/// Joints of an instrument that a table of positions must have.
struct InstrumentJoints {
  std::string instrument;           ///< Name in the scene.
  std::vector<std::string> joints;  ///< Names in the URDF.
};

/// Column of each joint of each instrument. Columns have names `joint`, or `instrument/joint`,
/// which is necessary for several instruments. Errors name `file`.
/// @throws InputError for a joint without a column or a column without a joint.
std::vector<std::vector<int>> jointColumns(const formats::Trajectory& trajectory,
                                           const std::vector<InstrumentJoints>& instruments,
                                           const std::string& file);

}  // namespace palpate::io

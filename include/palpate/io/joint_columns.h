// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/formats/trajectory.h"

namespace palpate::io {

/// What a table of joint positions has to have of an instrument.
struct InstrumentJoints {
  std::string instrument;           ///< Its name in the scene.
  std::vector<std::string> joints;  ///< Their names in its URDF.
};

/// The column of each joint of each instrument. Columns are the joints' names; `instrument/joint`
/// works always and is needed where there are several instruments. `file` is named in errors.
/// @throws InputError for a joint without a column or a column without a joint.
std::vector<std::vector<int>> jointColumns(const formats::Trajectory& trajectory,
                                           const std::vector<InstrumentJoints>& instruments,
                                           const std::string& file);

}  // namespace palpate::io

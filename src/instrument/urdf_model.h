// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <string>

#include "urdf_outline.h"

namespace palpate::instrument {

struct ParsedUrdf {
  urdf::ModelInterfaceSharedPtr model;  ///< Never null; without inertias, which are not needed.
  std::string complaints;               ///< urdfdom's messages, or "".
};

/// Parses the outline's text by urdfdom without output. @pre The outline has no problems.
/// @throws InputError with urdfdom's messages if it refuses the file or omits a part.
ParsedUrdf parseUrdf(const std::string& file, const UrdfOutline& outline);

}  // namespace palpate::instrument

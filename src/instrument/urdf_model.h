// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <string>

#include "urdf_outline.h"

namespace palpate::instrument {

struct ParsedUrdf {
  urdf::ModelInterfaceSharedPtr model;  ///< Never null; without inertias, nothing here needs them.
  std::string complaints;               ///< What urdfdom would have printed, or "".
};

/// Parses the outline's text by urdfdom, silently; the outline has no problems.
/// @throws InputError with urdfdom's complaints if it refuses the file, or leaves a part of it out.
ParsedUrdf parseUrdf(const std::string& file, const UrdfOutline& outline);

}  // namespace palpate::instrument

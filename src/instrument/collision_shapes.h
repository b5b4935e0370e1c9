// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <urdf_model/model.h>

#include <string>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/instrument/geometry.h"
#include "palpate/instrument/instrument.h"

namespace palpate::instrument {

struct Shapes {
  std::vector<CollisionBody> bodies;  ///< In the order of `links`.
  std::vector<std::string> warnings;
  std::vector<std::string> notes;
  std::vector<Problem> problems;
};

/// Collision bodies of the links, by name in the given order; also checks that visual meshes exist.
/// Relative mesh files start from `folder`.
Shapes readShapes(const urdf::ModelInterface& model, const std::vector<std::string>& links,
                  const std::string& folder, const InstrumentOptions& options);

}  // namespace palpate::instrument

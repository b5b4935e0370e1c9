// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "palpate/mesh/size_field.h"
#include "palpate/scene/scene.h"

namespace palpate::scene {

/// Path of the instrument's control frame for refinement zone `place` of the organ, in the organ's
/// frame [m], simplified within a tenth of the finest edge.
/// @throws InputError for a missing table, instrument or joint column, more than 100 m from the
/// organ, or more than 20000 corners.
mesh::Polyline toolPath(const Scene& scene, const OrganConfig& organ, std::size_t place);

}  // namespace palpate::scene

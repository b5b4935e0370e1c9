// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "palpate/mesh/size_field.h"
#include "palpate/scene/scene.h"

namespace palpate::scene {

/// The way of the instrument's control frame along the trajectory of a place in the organ's list,
/// in the organ's own frame [m]. Points without which the line stays within a tenth of the finest
/// edge are left out.
/// @throws InputError if the table or the instrument is not there, the table has no column for a
/// joint, or the way leads farther than 100 m or has more than 20000 corners.
mesh::Polyline toolPath(const Scene& scene, const OrganConfig& organ, std::size_t place);

}  // namespace palpate::scene

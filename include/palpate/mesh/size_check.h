// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/base/types.h"

namespace palpate::mesh {

constexpr double kMinOrganSize = 1e-3;  ///< [m]
constexpr double kMaxOrganSize = 2.0;   ///< [m]

/// Refuses a body whose bounding box's largest side is outside [kMinOrganSize, kMaxOrganSize]:
/// its file is most likely in another unit. The message names the size and the scale that the
/// file probably needs: that of millimetres, centimetres, micrometres or kilometres where the
/// body would become of an organ's size (2 cm to 0.5 m), else a power of ten.
///
/// @throws InputError with `file` and `key`; also if there is no point, one is not finite, or the
///   body has no extent.
void checkSize(const Points& points, const std::string& file, const std::string& key);

}  // namespace palpate::mesh

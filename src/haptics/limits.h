// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/base/types.h"

namespace palpate::haptics {

/// Scales `v` to the norm `limit` where it is longer; handles infinite components and squares.
Vec3 clamped(const Vec3& v, double limit);
/// Moves a vector towards another by at most `limit`.
Vec3 approached(const Vec3& from, const Vec3& to, double limit);

/// @throws std::invalid_argument that names `owner` and the setting, unless the value is finite and
/// > 0, or >= 0 for requireNotNegative().
void requirePositive(const std::string& owner, const std::string& name, double value);
void requireNotNegative(const std::string& owner, const std::string& name, double value);

}  // namespace palpate::haptics

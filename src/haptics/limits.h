// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/base/types.h"

namespace palpate::haptics {

/// `v` shortened to `limit` where it is longer. Finite components may have an infinite square, and
/// components may be infinite.
Vec3 clamped(const Vec3& v, double limit);
/// From one vector on the way to another, at most `limit` far.
Vec3 approached(const Vec3& from, const Vec3& to, double limit);

/// @throws std::invalid_argument that names `owner` and the setting, unless the value is finite and
/// > 0, or >= 0 for requireNotNegative().
void requirePositive(const std::string& owner, const std::string& name, double value);
void requireNotNegative(const std::string& owner, const std::string& name, double value);

}  // namespace palpate::haptics

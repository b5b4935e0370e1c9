// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/base/types.h"

namespace palpate {

/// "[0.1, -2, 0.0333333]", six digits each, for messages; independent of the locale.
std::string vectorText(const Vec3& v);

}  // namespace palpate

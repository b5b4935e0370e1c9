// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace palpate {

/// Names what determines the last bits of results apart from source and input: Eigen's vector
/// instructions and the variants of C library functions for this processor. Processes with equal
/// names round alike.
std::string rounding();

}  // namespace palpate

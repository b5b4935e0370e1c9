// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace palpate {

/// Names what else than source and input decides the last bits of results in this process: the
/// vector instructions that Eigen was compiled for, and which variants of its functions the C
/// library chose for the processor. Processes with equal names round alike.
std::string rounding();

}  // namespace palpate

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace palpate::start {

/// What is wrong with this process's BLAS and what to set, in a sentence, or "". It is measured,
/// which takes some ms.
std::string blasWarning();

}  // namespace palpate::start

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace palpate::start {

/// What is wrong with this process's BLAS and what to set, in a sentence, or "". It is measured,
/// which takes some ms, only where a step method of this name depends on it, or if `always`.
std::string blasWarningFor(const std::string& method, bool always = false);

}  // namespace palpate::start

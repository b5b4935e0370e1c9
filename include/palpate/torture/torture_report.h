// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/torture/result_table.h"

namespace palpate::torture {

/// Text of stability.md: scenes run, passes by category and by composition, worst cases, and
/// failures with the command that replays each.
std::string stabilityMarkdown(const std::vector<ResultLine>& lines);

/// "153 scenes: 136 passed, 17 failed, 0 refused, 0 left off".
std::string summary(const std::vector<ResultLine>& lines);

}  // namespace palpate::torture

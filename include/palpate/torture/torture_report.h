// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/torture/result_table.h"

namespace palpate::torture {

/// stability.md: what was run, what of it passed by category and by what a scene is made of,
/// the worst cases, and what fails, each with the command that replays it.
std::string stabilityMarkdown(const std::vector<ResultLine>& lines);

/// "153 scenes: 136 passed, 17 failed, 0 refused, 0 left off".
std::string summary(const std::vector<ResultLine>& lines);

}  // namespace palpate::torture

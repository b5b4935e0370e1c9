// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/analysis/solve_result.h"

namespace palpate::io {

/// The result as JSON; keys in the order of the structs, numbers with as many digits as bring back
/// the same bits, null for a number that is not finite.
std::string resultJson(const analysis::SolveResult& result);

/// @throws InputError if the file cannot be written.
void writeResultJson(const std::string& file, const analysis::SolveResult& result);

}  // namespace palpate::io

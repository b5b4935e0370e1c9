// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/analysis/solve_result.h"

namespace palpate::io {

/// The result as JSON, with keys in the order of the structs, numbers that are read back exactly,
/// and null for non-finite ones.
std::string resultJson(const analysis::SolveResult& result);

/// @throws InputError if the file cannot be written.
void writeResultJson(const std::string& file, const analysis::SolveResult& result);

}  // namespace palpate::io

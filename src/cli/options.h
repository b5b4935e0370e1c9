// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace palpate::cli {

/// @throws InputError naming the option unless `value` is a finite number > 0.
void requirePositive(const std::string& option, double value);

/// The same for a finite number >= 0.
void requireNotNegative(const std::string& option, double value);

/// So that long work is not done for a file that cannot be written.
/// @throws InputError naming the option unless `file` ends in one of `extensions` (".vtu") and its
/// folder exists and can be written to.
void requireWritable(const std::string& option, const std::string& file,
                     const std::vector<std::string>& extensions);

}  // namespace palpate::cli

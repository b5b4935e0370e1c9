// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

namespace palpate {

/// All bytes of a file, in memory of at most the file's size or `max_bytes`.
/// @throws InputError if it does not exist, cannot be read, is larger than `max_bytes`, or is no
/// regular file: a pipe or a device may have no end, or never begin.
std::string readTextFile(const std::string& file, std::size_t max_bytes);

}  // namespace palpate

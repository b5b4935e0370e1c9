// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

namespace palpate {

/// All bytes of a file.
/// @throws InputError if it does not exist, is no regular file, cannot be read, or is larger than
/// `max_bytes`.
std::string readTextFile(const std::string& file, std::size_t max_bytes);

}  // namespace palpate

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace palpate::formats {

/// The whole file. @throws InputError if it is missing, no regular file, unreadable or empty.
std::string readFileBytes(const std::string& file);

/// Writes beside `file` and renames: readers see the old file or the new one, never a part.
/// @throws std::runtime_error if that fails; nothing is left behind.
void writeFileAtomically(const std::string& file, std::string_view bytes);

/// ".obj" of "a/Liver.OBJ"; "" if there is none.
std::string lowerCaseExtension(const std::string& file);

}  // namespace palpate::formats

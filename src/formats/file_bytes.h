// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace palpate::formats {

/// The whole file. @throws InputError if it is missing, no regular file, unreadable, empty or
/// larger than 2 GiB.
std::string readFileBytes(const std::string& file);

/// ASCII letters in lower case; others stay.
std::string lowerCase(std::string_view word);

/// ".obj" of "a/Liver.OBJ"; "" if there is none.
std::string lowerCaseExtension(const std::string& file);

}  // namespace palpate::formats

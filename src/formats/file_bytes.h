// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace palpate::formats {

/// The whole file. @throws InputError for a missing, unreadable or empty file, one that is not
/// regular, or larger than 2 GiB.
std::string readFileBytes(const std::string& file);

/// Converts ASCII letters to lower case.
std::string lowerCase(std::string_view word);

/// Extension, ".obj" for "a/Liver.OBJ"; "" if there is none.
std::string lowerCaseExtension(const std::string& file);

}  // namespace palpate::formats

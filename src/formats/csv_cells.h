// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

namespace palpate::formats {

/// `text` without leading and trailing blanks and tabs.
std::string_view trimmed(std::string_view text);

/// Comma-separated parts of a line, trimmed; views of `line`. Quotes have no meaning.
std::vector<std::string_view> csvCells(std::string_view line);

}  // namespace palpate::formats

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

namespace palpate::formats {

/// `text` without the blanks and tabs at its ends.
std::string_view trimmed(std::string_view text);

/// What stands between the commas of a line, trimmed; one more than there are commas. Quotes have
/// no meaning. The pieces are parts of `line`.
std::vector<std::string_view> csvCells(std::string_view line);

}  // namespace palpate::formats

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace palpate {

/// The number that strtod() makes of the whole of `text`, in the C locale: also infinite, NaN,
/// hexadecimal. Nothing if something else stands there.
std::optional<double> parseAnyNumber(std::string_view text);

/// The finite decimal number that `text` is from its first to its last character, else nothing:
/// "nan", "inf", hexadecimal, blanks and numbers beyond the range of double are refused. The
/// process's locale plays no part.
std::optional<double> parseNumber(std::string_view text);

/// Shortest of 15, 16 and 17 digits that parseNumber() turns into the same bits; "nan", "inf",
/// "-inf" for what is no number. The process's locale plays no part.
std::string formatNumber(double value);

}  // namespace palpate

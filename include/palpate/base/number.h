// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace palpate {

/// The number that strtod() reads from the whole `text` in the C locale, also infinite, NaN or
/// hexadecimal; empty for anything else.
std::optional<double> parseAnyNumber(std::string_view text);

/// The finite decimal number in the whole `text`, independent of the locale. Empty for "nan",
/// "inf", hexadecimal, blanks and numbers beyond the range of double.
std::optional<double> parseNumber(std::string_view text);

/// Shortest of 15, 16 and 17 digits that parseNumber() reads back exactly, independent of the
/// locale; "nan", "inf" or "-inf" for other values.
std::string formatNumber(double value);

}  // namespace palpate

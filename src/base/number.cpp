// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/number.h"

#include <locale.h>  // newlocale, strtod_l: POSIX
#include <stdlib.h>

#include <cmath>
#include <locale>
#include <sstream>

namespace palpate {

std::optional<double> parseAnyNumber(std::string_view text) {
  static const locale_t kClassic = newlocale(LC_ALL_MASK, "C", nullptr);
  char few[64];  // enough for nearly all numbers, without allocation
  std::string many;
  const char* begin = few;
  if (text.size() < sizeof few) {
    few[text.copy(few, sizeof few - 1)] = '\0';
  } else {
    many = text;
    begin = many.c_str();
  }
  char* end = nullptr;
  const double value = strtod_l(begin, &end, kClassic);
  if (text.empty() || end != begin + text.size()) return {};
  return value;
}

std::optional<double> parseNumber(std::string_view text) {
  if (text.find_first_not_of("0123456789+-.eE") != std::string_view::npos) return {};
  const std::optional<double> value = parseAnyNumber(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::string formatNumber(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  std::string text;
  for (int digits = 15; digits <= 17; ++digits) {
    std::ostringstream stream;
    stream.imbue(std::locale::classic());
    stream.precision(digits);
    stream << value;
    text = stream.str();
    if (parseAnyNumber(text) == value) break;
  }
  return text;
}

}  // namespace palpate

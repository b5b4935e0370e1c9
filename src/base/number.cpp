// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/number.h"

#include <locale.h>  // newlocale, strtod_l: POSIX
#include <stdlib.h>

#include <cmath>
#include <locale>
#include <sstream>

namespace palpate {

double toDouble(const char* text, char** end) {
  static const locale_t kClassic = newlocale(LC_ALL_MASK, "C", nullptr);
  return strtod_l(text, end, kClassic);
}

std::optional<double> parseNumber(const std::string& text) {
  if (text.empty() || text.find_first_not_of("0123456789+-.eE") != std::string::npos) return {};
  char* end = nullptr;
  const double value = toDouble(text.c_str(), &end);
  if (end != text.c_str() + text.size() || !std::isfinite(value)) return {};
  return value;
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
    if (toDouble(text.c_str(), nullptr) == value) break;
  }
  return text;
}

}  // namespace palpate

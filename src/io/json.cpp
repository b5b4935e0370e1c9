// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/io/json.h"

#include <cmath>

#include "palpate/base/number.h"

namespace palpate::io {

std::string jsonText(const std::string& text) {
  static const char kHex[] = "0123456789abcdef";
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (byte < 0x20) {
      result += "\\u00";
      result += kHex[byte >> 4];
      result += kHex[byte & 15];
    } else {
      result += c;
    }
  }
  return result + "\"";
}

std::string json(double value) { return std::isfinite(value) ? formatNumber(value) : "null"; }

std::string json(const Eigen::Ref<const Eigen::VectorXd>& values) {
  std::string text;
  for (Eigen::Index i = 0; i < values.size(); ++i) text += (i ? ", " : "") + json(values(i));
  return "[" + text + "]";
}

}  // namespace palpate::io

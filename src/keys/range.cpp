// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/keys/range.h"

#include <cmath>

#include "palpate/base/number.h"

namespace palpate::keys {

bool Range::contains(double x) const {
  if (!std::isfinite(x)) return false;
  return (low_open_ ? x > low_ : x >= low_) && (high_open_ ? x < high_ : x <= high_);
}

std::string Range::text() const {
  const bool bounded_below = std::isfinite(low_), bounded_above = std::isfinite(high_);
  if (bounded_below && bounded_above) {
    return "in " + std::string(low_open_ ? "(" : "[") + formatNumber(low_) + ", " +
           formatNumber(high_) + (high_open_ ? ")" : "]");
  }
  if (bounded_below) return (low_open_ ? "> " : ">= ") + formatNumber(low_);
  if (bounded_above) return (high_open_ ? "< " : "<= ") + formatNumber(high_);
  return "finite";
}

}  // namespace palpate::keys

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <string>

namespace palpate::keys {

/// Allowed numbers of a field, without NaN and infinity.
class Range {
 public:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  /// All finite numbers.
  static Range any() { return {-kInfinity, kInfinity, true, true}; }
  /// low < x <= high.
  static Range above(double low, double high = kInfinity) { return {low, high, true, false}; }
  /// low <= x <= high.
  static Range closed(double low, double high = kInfinity) { return {low, high, false, false}; }
  /// low < x < high.
  static Range open(double low, double high) { return {low, high, true, true}; }

  bool contains(double x) const;  ///< False for NaN and infinities.
  /// "> 0", ">= 1", "in (0, 0.1]", "in [1, 1000]"; "finite" without bounds.
  std::string text() const;

 private:
  Range(double low, double high, bool low_open, bool high_open)
      : low_(low), high_(high), low_open_(low_open), high_open_(high_open) {}

  double low_, high_;
  bool low_open_, high_open_;
};

/// Range of a coordinate [m].
inline Range coordinateRange() { return Range::closed(-100.0, 100.0); }

}  // namespace palpate::keys

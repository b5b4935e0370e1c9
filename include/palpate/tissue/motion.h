// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::tissue {

/// Names of Wave::form.
std::vector<std::string> waveFormNames();

/// A motion along a line, again and again:
///
///   sine   sin(2 pi c)
///   cos4   cos^4(pi (c - 1/2)): breathing, which dwells at the end of expiration, where c is whole
///          [Lujan, Larsen, Balter, Ten Haken 1999, eq. 1, with n = 2]
///
/// times `amplitude`, after c = t/period + phase cycles.
struct Wave {
  std::string form = "sine";
  Vec3 amplitude = Vec3::Zero();  ///< World [m].
  double period = 1.0;            ///< [s]
  double phase = 0.0;             ///< In cycles.
};

/// A motion along a table: displacements from the first one, between them by cubic Hermite
/// interpolation with the slopes of parabolas through three rows. Neither it nor its velocity
/// leaps.
struct MotionTable {
  std::vector<double> t;  ///< [s], from zero, increasing; at least two.
  Points at;              ///< Of each, world [m]; where periodic, the last is the first.
  bool periodic = false;  ///< Else it stays where the last row is.
};

/// How something is displaced over time, from nowhere at t = 0, at rest there.
class Motion {
 public:
  /// The wave grows to its size within the first period.
  explicit Motion(const Wave& wave);
  /// A table that is periodic grows to its size within the first period, too; another one begins
  /// and ends with no velocity.
  /// @throws std::invalid_argument for a table that is not as MotionTable says.
  explicit Motion(MotionTable table);

  /// Displacement [m] at time t >= 0 [s].
  Vec3 at(double t) const;

 private:
  std::variant<Wave, MotionTable> way_;
  Points slopes_;  // of the table [m/s]
};

}  // namespace palpate::tissue

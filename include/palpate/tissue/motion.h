// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::tissue {

/// Names of Wave::form.
std::vector<std::string> waveFormNames();

/// A periodic motion along a line:
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

/// A motion by a table of displacements from the first row: cubic Hermite interpolation with slopes
/// of parabolas through three rows. Displacement and velocity are continuous.
struct MotionTable {
  std::vector<double> t;  ///< [s], from zero, increasing; at least two.
  Points at;  ///< Displacement of each row, world [m]; if periodic, the last equals the first.
  bool periodic = false;  ///< False: the last row's displacement lasts.
};

/// Displacement as a function of time, zero and at rest at t = 0.
class Motion {
 public:
  /// The amplitude grows to its value within the first period.
  explicit Motion(const Wave& wave);
  /// A periodic table grows to its amplitude within the first period; another one begins and ends
  /// with zero velocity.
  /// @throws std::invalid_argument for a table that violates MotionTable.
  explicit Motion(MotionTable table);

  /// Displacement [m] at time t >= 0 [s].
  Vec3 at(double t) const;

 private:
  std::variant<Wave, MotionTable> way_;
  Points slopes_;  // of the table [m/s]
};

}  // namespace palpate::tissue

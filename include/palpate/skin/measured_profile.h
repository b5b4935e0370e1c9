// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace palpate::skin {

/// The surface of a primate's fingertip under a line load [Srinivasan 1989], as digitised in
/// [Triantafyllopoulos 2005, 3.2].
struct MeasuredProfile {
  std::string name;
  double nominal_depth;          ///< As the experiment is called [m]
  double start_depth;            ///< From which a correction of the depth starts, and from which
                                 ///< readings are taken [m]
  std::vector<double> radii;     ///< From the load [mm]
  std::vector<double> readings;  ///< On the digitiser
  std::vector<double> printed;   ///< Depths of the surface as printed [mm]

  int size() const { return static_cast<int>(radii.size()); }
  double radius(int k) const { return 1e-3 * radii[static_cast<std::size_t>(k)]; }  ///< [m]
  /// Of the surface at a radius: start_depth less reading times scale [m].
  double depth(int k) const;
};

constexpr int kProfileSets = 2;
constexpr double kReadingScale = 0.45 / 1.6;  ///< [mm] a reading

/// Set 1 ("2 mm") or 2 ("1 mm"). @throws std::out_of_range for another.
const MeasuredProfile& measuredProfile(int set);

}  // namespace palpate::skin

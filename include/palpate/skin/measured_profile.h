// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace palpate::skin {

/// Surface of a primate's fingertip under a line load [Srinivasan 1989], as digitised in
/// [Triantafyllopoulos 2005, 3.2].
struct MeasuredProfile {
  std::string name;
  double nominal_depth;          ///< Name of the experiment [m]
  double start_depth;            ///< Origin of the readings, and start of the depth's correction
                                 ///< [m]
  std::vector<double> radii;     ///< Distance from the load [mm]
  std::vector<double> readings;  ///< Of the digitiser
  std::vector<double> printed;   ///< Printed depths of the surface [mm]

  int size() const { return static_cast<int>(radii.size()); }
  double radius(int k) const { return 1e-3 * radii[static_cast<std::size_t>(k)]; }  ///< [m]
  /// Depth of the surface at radius k: start_depth minus scaled reading [m].
  double depth(int k) const;
};

constexpr int kProfileSets = 2;
constexpr double kReadingScale = 0.45 / 1.6;  ///< [mm] per reading

/// Set 1 ("2 mm") or 2 ("1 mm"). @throws std::out_of_range for another set.
const MeasuredProfile& measuredProfile(int set);

}  // namespace palpate::skin

// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/skin/measured_profile.h"

#include <stdexcept>

namespace palpate::skin {

double MeasuredProfile::depth(int k) const {
  return start_depth - 1e-3 * kReadingScale * readings[static_cast<std::size_t>(k)];
}

const MeasuredProfile& measuredProfile(int set) {
  static const MeasuredProfile kProfiles[kProfileSets] = {
      {"2 mm",
       0.002,
       0.0018,
       {0.25, 0.30, 0.35, 0.40, 0.45, 0.50, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 5.5,
        6.0},
       {0.0, 0.18, 0.30, 0.43, 0.55, 0.70, 1.20, 1.60, 2.42, 3.11, 3.70, 4.35, 4.80, 5.15, 5.50,
        6.00, 6.30, 6.40},
       {1.80, 1.75, 1.72, 1.68, 1.65, 1.60, 1.46, 1.35, 1.12, 0.93, 0.76, 0.58, 0.45, 0.35, 0.25,
        0.11, 0.03, 0.00}},
      {"1 mm",
       0.001,
       0.0009,
       {0.25, 0.30, 0.35, 0.40, 0.45, 0.50, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0},
       {0.25, 0.40, 0.50, 0.60, 0.70, 0.80, 1.10, 1.35, 1.70, 2.20, 2.45, 2.65},
       {0.83, 0.79, 0.76, 0.73, 0.70, 0.68, 0.59, 0.52, 0.42, 0.28, 0.21, 0.15}}};
  if (set < 1 || set > kProfileSets) {
    throw std::out_of_range("profile set " + std::to_string(set) + "; must be 1 or 2");
  }
  return kProfiles[set - 1];
}

}  // namespace palpate::skin

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/keys/fields.h"

namespace palpate::node {

/// How organs are shown cut open: private parameters below ~cutaway. All in each organ's own frame.
struct CutawayConfig {
  /// What is taken away, seen from `at`, along each axis: 1 beyond, -1 before, 0 all. One axis
  /// takes a half, two a quarter, three an eighth.
  Eigen::Vector3i corner{1, -1, 0};
  Vec3 at = Vec3::Zero();    ///< [m]
  bool has_place = false;    ///< Without: the middle of each organ at rest.
  Vec3 size = Vec3::Zero();  ///< Of what is taken away, from `at` on [m]; 0: to the end.
  double rate = 5.0;         ///< Pictures in a second, at most [Hz].
};

inline constexpr char kCutawaySection[] = "cutaway";
inline constexpr const char* kCutawayParams[] = {"corner", "at", "size", "rate"};

void describe(keys::FieldVisitor& v, CutawayConfig& cutaway);

}  // namespace palpate::node

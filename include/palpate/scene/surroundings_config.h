// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpate/fem/cavity.h"
#include "palpate/fem/foundation.h"
#include "palpate/keys/fields.h"
#include "palpate/mesh/selection.h"
#include "palpate/tissue/motion.h"

namespace palpate::scene {

/// A motion, of a wave or of a table; vectors are in the organ's own frame.
struct MotionConfig : tissue::Wave {
  std::string file;                                ///< A table `t, x, y, z` in place of a wave.
  bool periodic = tissue::MotionTable().periodic;  ///< The table begins anew at its end.
};

/// What holds a part of an organ.
struct SupportConfig {
  mesh::Region select;        ///< In the organ's own frame, after scaling.
  std::string kind = "glue";  ///< One of supportKindNames().
  fem::FoundationConstants springs;
  std::optional<double> stiffness;     ///< Of a `slide` [Pa/m]; none: slideStiffness().
  std::optional<MotionConfig> motion;  ///< Of what it is held by.
};

/// Pressure on the surface of a cavity or of another part of an organ.
struct PressureConfig : fem::CavityContent {
  std::optional<int> cavity;           ///< Of mesh::cavityNodes(), or
  std::optional<mesh::Region> select;  ///< faces of the surface, in the organ's own frame.
};

/// {"glue", "slide", "springs"}; the first is the default.
std::vector<std::string> supportKindNames();

void describe(keys::FieldVisitor& v, MotionConfig& motion);
void describe(keys::FieldVisitor& v, SupportConfig& support);
void describe(keys::FieldVisitor& v, PressureConfig& pressure);

}  // namespace palpate::scene

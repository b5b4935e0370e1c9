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

/// A motion as a wave or a table; vectors are in the organ's frame.
struct MotionConfig : tissue::Wave {
  std::string file;                                ///< Table `t, x, y, z` instead of a wave.
  bool periodic = tissue::MotionTable().periodic;  ///< Whether the table repeats.
};

/// A support of a part of an organ.
struct SupportConfig {
  mesh::Region select;        ///< In the organ's frame, after scaling.
  std::string kind = "glue";  ///< One of supportKindNames().
  fem::FoundationConstants springs;
  std::optional<double> stiffness;     ///< Of a `slide` [Pa/m]; empty: slideStiffness().
  std::optional<MotionConfig> motion;  ///< Motion of the support.
};

/// Pressure on the surface of a cavity or on selected faces of an organ.
struct PressureConfig : fem::CavityContent {
  std::optional<int> cavity;           ///< Index in mesh::cavityNodes(); excludes `select`.
  std::optional<mesh::Region> select;  ///< Selects faces, in the organ's frame.
};

/// {"glue", "slide", "springs"}; the first is the default.
std::vector<std::string> supportKindNames();

void describe(keys::FieldVisitor& v, MotionConfig& motion);
void describe(keys::FieldVisitor& v, SupportConfig& support);
void describe(keys::FieldVisitor& v, PressureConfig& pressure);

}  // namespace palpate::scene

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "palpate/keys/fields.h"

namespace palpate::tissue {

/// How a sheet is rolled up when a scene begins [Wang 2005, 6.4.2]: its edge of least y stays where
/// it is at rest, and from there it is wound upward around an axis along x,
///
///   r(beta) = radius (1 - loss beta).
struct RolledSettings {
  double radius = 0.01;      ///< R_t, of the outermost layer [m]
  double loss = 0.03;        ///< c, the part of it that is lost in a radian
  double gap_least = 1e-4;   ///< T_l: layers come no nearer [m], and
  double gap_most = 1.0e-3;  ///< T_h: farther apart they do not act on one another [m].
};

/// Of an organ of model cloth: a sheet in the place of a body.
struct ClothSettings {
  double thickness = 0.0;  ///< [m], > 0
  bool preload = true;     ///< Springs bend as the sheet does; else bending costs nothing.
  /// Of a rectangle [0, width] x [0, length] at z = 0 that is made of triangles [m]; 0: it is read.
  double width = 0.0, length = 0.0;
  double spacing = 0.0;  ///< Of its points [m].
  std::optional<RolledSettings> rolled;

  bool made() const { return width > 0.0 || length > 0.0 || spacing > 0.0; }
};

void describe(keys::FieldVisitor& v, RolledSettings& rolled);
void describe(keys::FieldVisitor& v, ClothSettings& cloth);

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/instrument/geometry.h"

namespace palpate::contact {

/// Something rigid on its way through a cycle, or a part of one: a collision shape of an
/// instrument.
struct Obstacle {
  const instrument::Geometry* geometry;
  int owner;        ///< Whose it is, by who made it: the instrument's index.
  Pose X_WG_begin;  ///< The shape's frame in world, where the way begins,
  Pose X_WG_end;    ///< and where it ends.
  int number = 0;   ///< Among all obstacles of a cycle; a memory of touches knows it by this.
};

}  // namespace palpate::contact

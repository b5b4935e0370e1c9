// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/contact/needle.h"
#include "palpate/instrument/geometry.h"

namespace palpate::contact {

/// Owner of an obstacle: an instrument, or a part of the anatomy, which never moves.
struct Owner {
  Owner(int instrument = 0) : index(instrument) {}  // NOLINT(google-explicit-constructor)
  static Owner anatomy(int index) {
    Owner owner(index);
    owner.fixed = true;
    return owner;
  }

  bool isInstrument() const { return !fixed; }

  int index;           ///< Index among the instruments, or among the parts of the anatomy.
  bool fixed = false;  ///< True for a part of the anatomy.
};

/// A rigid shape with its motion in a cycle or step: a collision shape of an instrument, or a part
/// of the anatomy.
struct Obstacle {
  const instrument::Geometry* geometry;
  Owner owner;
  Pose X_WG_begin;  ///< Pose of the shape's frame G at the begin.
  Pose X_WG_end;    ///< Pose of the shape's frame G at the end.
  int number = 0;   ///< Index among all obstacles of a cycle; states of touches refer to it.
  /// Puncture settings of a capsule or cylinder; null: no needle.
  const NeedleSettings* needle = nullptr;
};

}  // namespace palpate::contact

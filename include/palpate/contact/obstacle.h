// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/contact/needle.h"
#include "palpate/instrument/geometry.h"

namespace palpate::contact {

/// Whose an obstacle is: an instrument's, or a part of the anatomy, which never moves.
struct Owner {
  Owner(int instrument = 0) : index(instrument) {}  // NOLINT(google-explicit-constructor)
  static Owner anatomy(int index) {
    Owner owner(index);
    owner.fixed = true;
    return owner;
  }

  bool isInstrument() const { return !fixed; }

  int index;           ///< Among the instruments, or the anatomy.
  bool fixed = false;  ///< It is of the anatomy.
};

/// Something rigid on its way through a cycle, or a part of one: a collision shape of an
/// instrument, or a part of the anatomy.
struct Obstacle {
  const instrument::Geometry* geometry;
  Owner owner;
  Pose X_WG_begin;  ///< The shape's frame in world, where the way begins,
  Pose X_WG_end;    ///< and where it ends.
  int number = 0;   ///< Among all obstacles of a cycle; a memory of touches knows it by this.
  /// How it goes into tissue, a capsule or a cylinder; null: not at all.
  const NeedleSettings* needle = nullptr;
};

}  // namespace palpate::contact

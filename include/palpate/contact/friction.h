// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace palpate::keys {
class FieldVisitor;
}

namespace palpate::contact {

/// Friction between tissue and an obstacle: the constants of all friction laws. A law whose
/// constants are 0 has no effect.
struct Friction {
  double at_rest = 0.0;  ///< Static coefficient of Coulomb's law [-].
  double sliding = 0.0;  ///< Kinetic coefficient, <= at_rest [-].
  /// Traction up to which a toothed obstacle, once pressed, holds tissue in all directions [Pa];
  /// 0: no teeth.
  double teeth = 0.0;

  bool any() const;  ///< Whether a friction law has an effect.
};

/// Describes the keys of all friction laws.
void describeFriction(keys::FieldVisitor& v, Friction& friction);

/// The friction of a body with all obstacles of a cycle.
struct FrictionTable {
  Friction usual;                   ///< Friction of obstacles that are not in by_number.
  std::vector<Friction> by_number;  ///< By Obstacle::number.

  const Friction& of(int number) const;
  bool any() const;
};

}  // namespace palpate::contact

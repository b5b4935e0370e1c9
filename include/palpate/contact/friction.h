// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace palpate::contact {

/// How tissue clings to an obstacle.
struct Friction {
  double at_rest = 0.0;  ///< Coulomb's coefficient until it slips,
  double sliding = 0.0;  ///< and while it slips, not larger.
  /// Pressed into the tissue, the obstacle holds it in every direction, until that takes more
  /// traction than this [Pa]; 0: it has no teeth.
  double teeth = 0.0;

  bool any() const { return at_rest > 0.0 || teeth > 0.0; }
  double coefficient(bool slides) const { return slides ? sliding : at_rest; }
};

/// The friction of a body with all obstacles of a cycle.
struct FrictionTable {
  Friction usual;                   ///< Of obstacles that are not in the list.
  std::vector<Friction> by_number;  ///< By Obstacle::number.

  const Friction& of(int number) const;
  bool any() const;
  double strongestTeeth() const;  ///< [Pa]
};

}  // namespace palpate::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "friction_law.h"
#include "palpate/keys/fields.h"

namespace palpate::contact {

/// Teeth: they hold what they pressed in all directions up to a traction, and limit nothing else.
class TeethFriction final : public FrictionLaw {
 public:
  static constexpr const char* kName = "teeth";
  static Friction example() { return {0.0, 0.0, 1.0e4}; }

  void describe(keys::FieldVisitor& v, Friction& friction) const override {
    v.number({"teeth", "Pa",
              "What presses holds the tissue in every direction, until it is drawn by more than "
              "this or presses no more; 0: it has no teeth."},
             friction.teeth, keys::Range::closed(0.0, 1.0e9));
  }
  bool acts(const Friction& friction) const override { return friction.teeth > 0.0; }
  double holding(const Friction& friction) const override { return friction.teeth; }
};

}  // namespace palpate::contact

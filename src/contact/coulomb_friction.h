// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "friction_law.h"
#include "palpate/keys/fields.h"

namespace palpate::contact {

/// Coulomb's law: the limit is mu N with the normal force N; mu is the static coefficient, or the
/// kinetic one of a touch that slips [Wriggers 2006, Computational contact mechanics].
class CoulombFriction final : public FrictionLaw {
 public:
  static constexpr const char* kName = "coulomb";
  static Friction example() { return {0.5, 0.3, 0.0}; }

  void describe(keys::FieldVisitor& v, Friction& friction) const override {
    const keys::Range coefficients = keys::Range::closed(0.0, 10.0);
    std::optional<double> kinetic;
    if (friction.sliding != friction.at_rest) kinetic = friction.sliding;
    v.number({"static", "", "Coulomb's coefficient of what has not slipped; 0: there is none."},
             friction.at_rest, coefficients);
    v.number({"kinetic", "", "And of what slips; where left out, `static`."}, kinetic,
             coefficients);
    friction.sliding = kinetic.value_or(friction.at_rest);
    v.rule(friction.sliding <= friction.at_rest, "kinetic", "must not be larger than static");
  }
  bool acts(const Friction& friction) const override { return friction.at_rest > 0.0; }
  FrictionLimit limit(const Friction& friction, const FrictionLoad& load) const override {
    const double mu = load.slides ? friction.sliding : friction.at_rest;
    return {mu * load.normal_force, mu};
  }
  bool weakens(const Friction& friction) const override {
    return friction.sliding < friction.at_rest;
  }
};

}  // namespace palpate::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "friction_law.h"

namespace palpate::contact {

struct FrictionEntry {
  std::string name;
  std::shared_ptr<const FrictionLaw> law;
  Friction example;  ///< Constants with which this law of the list acts, and no other; for tests.
};
using FrictionList = std::vector<FrictionEntry>;

/// All friction laws; their keys are documented in this order.
const FrictionList& frictionList();

// What the laws of a list are together, with the constants `friction`.
bool anyActs(const FrictionList& laws, const Friction& friction);
/// The sum of all limits.
FrictionLimit limitOf(const FrictionList& laws, const Friction& friction, const FrictionLoad& load);
bool anyWeakens(const FrictionList& laws, const Friction& friction);
/// The sum of all tractions [Pa].
double holdingOf(const FrictionList& laws, const Friction& friction);
/// The largest holdingOf() of a table [Pa].
double strongestHolding(const FrictionList& laws, const FrictionTable& table);

}  // namespace palpate::contact

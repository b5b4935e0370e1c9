// SPDX-License-Identifier: GPL-3.0-or-later
#include "friction_list.h"

#include <algorithm>

#include "coulomb_friction.h"
#include "teeth_friction.h"

namespace palpate::contact {
namespace {

template <class Law>
FrictionEntry entryOf() {
  return {Law::kName, std::make_shared<const Law>(), Law::example()};
}

}  // namespace

// To add one: write its header, include it, add it here.
const FrictionList& frictionList() {
  static const FrictionList kLaws = {
      entryOf<CoulombFriction>(),
      entryOf<TeethFriction>(),
  };
  return kLaws;
}

bool anyActs(const FrictionList& laws, const Friction& friction) {
  return std::any_of(laws.begin(), laws.end(),
                     [&](const FrictionEntry& entry) { return entry.law->acts(friction); });
}

FrictionLimit limitOf(const FrictionList& laws, const Friction& friction,
                      const FrictionLoad& load) {
  FrictionLimit sum;
  for (const FrictionEntry& entry : laws) {
    const FrictionLimit one = entry.law->limit(friction, load);
    sum.force += one.force;
    sum.slope += one.slope;
  }
  return sum;
}

bool anyWeakens(const FrictionList& laws, const Friction& friction) {
  return std::any_of(laws.begin(), laws.end(),
                     [&](const FrictionEntry& entry) { return entry.law->weakens(friction); });
}

double holdingOf(const FrictionList& laws, const Friction& friction) {
  double sum = 0.0;
  for (const FrictionEntry& entry : laws) sum += entry.law->holding(friction);
  return sum;
}

double strongestHolding(const FrictionList& laws, const FrictionTable& table) {
  double most = holdingOf(laws, table.usual);
  for (const Friction& friction : table.by_number) {
    most = std::max(most, holdingOf(laws, friction));
  }
  return most;
}

}  // namespace palpate::contact

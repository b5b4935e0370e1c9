// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/friction.h"

#include <algorithm>

#include "friction_list.h"

namespace palpate::contact {

bool Friction::any() const { return anyActs(frictionList(), *this); }

void describeFriction(keys::FieldVisitor& v, Friction& friction) {
  for (const FrictionEntry& entry : frictionList()) entry.law->describe(v, friction);
}

const Friction& FrictionTable::of(int number) const {
  const auto k = static_cast<std::size_t>(number);
  return k < by_number.size() ? by_number[k] : usual;
}

bool FrictionTable::any() const {
  return usual.any() ||
         std::any_of(by_number.begin(), by_number.end(), [](const Friction& f) { return f.any(); });
}

}  // namespace palpate::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/friction.h"

#include <algorithm>

namespace palpate::contact {

const Friction& FrictionTable::of(int number) const {
  const auto k = static_cast<std::size_t>(number);
  return k < by_number.size() ? by_number[k] : usual;
}

bool FrictionTable::any() const {
  return usual.any() ||
         std::any_of(by_number.begin(), by_number.end(), [](const Friction& f) { return f.any(); });
}

double FrictionTable::strongestTeeth() const {
  double most = usual.teeth;
  for (const Friction& friction : by_number) most = std::max(most, friction.teeth);
  return most;
}

}  // namespace palpate::contact

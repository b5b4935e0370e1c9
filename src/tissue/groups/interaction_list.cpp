// SPDX-License-Identifier: GPL-3.0-or-later
#include "organ_contact.h"
#include "palpate/tissue/interaction.h"

namespace palpate::tissue {

// To add one: write its header and source, add it here.
const std::vector<InteractionEntry>& interactions() {
  static const std::vector<InteractionEntry> kInteractions = {
      {"contact", makeOrganContact},
  };
  return kInteractions;
}

bool boxesOverlap(const InteractingBody& a, const InteractingBody& b, double reach) {
  const double margin = a.way + b.way + reach;
  return (a.low.array() <= b.high.array() + margin).all() &&
         (b.low.array() <= a.high.array() + margin).all();
}

}  // namespace palpate::tissue
